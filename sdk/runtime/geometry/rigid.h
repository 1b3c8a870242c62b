// Rigid transform, named target_from_source: x_target = rotation x_source + translation_m.
#pragma once
#include "runtime/geometry/rotation.h"
#include "spherecloud/spherecloud.h"

namespace sphc {

struct Rigid {
  Matrix3 rotation = Matrix3::Identity();
  Vector3 translation_m = Vector3::Zero();

  Vector3 operator*(const Vector3 &x_source) const { return rotation * x_source + translation_m; }
  Rigid operator*(const Rigid &source_from_other) const;
  Rigid inverse() const;
};

Rigid rigidFromC(const sphc_rigid &rigid_c);
sphc_rigid rigidToC(const Rigid &rigid);
// Finite, and the quaternion's length within 1e-3 of 1.
bool isValidRigid(const sphc_rigid &rigid_c);

}  // namespace sphc
