// A surface for the depth camera to see.
#pragma once
#include <functional>

#include "runtime/geometry/rigid.h"

namespace sphc::test {

// The plane n . x = d in the depth camera's frame, metres: depth along the ray (x, y, 1).
inline std::function<double(const Vector2 &)> plane(const Vector3 &n, double d) {
  return [=](const Vector2 &ray) { return d / n.dot(Vector3(ray.x(), ray.y(), 1)); };
}

}  // namespace sphc::test
