// The camera through which inversion looks: square, no distortion, fixed since a network was trained for it.
#pragma once
#include <cmath>

#include "runtime/geometry/rotation.h"

namespace sphc::host {

struct VirtualCamera {
  static constexpr int kSide = 128;             // px, both ways; pixel centres at .5
  static constexpr double kFocalPx = 137.2484;  // a field of 50 degrees

  // Pixel of a point or direction in camera axes; false where it is out of view.
  static bool project(const Vector3 &seen, Vector2 *pixel_px) {
    if (!(seen.z() > 0)) return false;
    *pixel_px = kFocalPx / seen.z() * seen.head<2>() + Vector2::Constant(kSide / 2.0);
    return (pixel_px->array() >= 0).all() && (pixel_px->array() < kSide).all();
  }
  static Vector3 ray(const Vector2 &pixel_px) {
    const Vector2 flat = (pixel_px - Vector2::Constant(kSide / 2.0)) / kFocalPx;
    return Vector3(flat.x(), flat.y(), 1);
  }
};

}  // namespace sphc::host
