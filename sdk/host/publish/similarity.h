// Rotation, translation and scale between the frames of two models.
#pragma once
#include "runtime/geometry/rotation.h"

namespace sphc::host {

// x_place = scale rotation x_model + translation_m
struct Similarity {
  double scale = 1;
  Matrix3 rotation = Matrix3::Identity();
  Vector3 translation_m = Vector3::Zero();

  Vector3 operator*(const Vector3 &x_model) const { return scale * (rotation * x_model) + translation_m; }
};

}  // namespace sphc::host
