#include "runtime/geometry/rigid.h"

namespace sphc {

Rigid Rigid::operator*(const Rigid &source_from_other) const {
  return {rotation * source_from_other.rotation, *this * source_from_other.translation_m};
}

Rigid Rigid::inverse() const { return {rotation.transpose(), -(rotation.transpose() * translation_m)}; }

Rigid rigidFromC(const sphc_rigid &rigid_c) {
  return {rotationFromQuaternion(rigid_c.q_wxyz), Vector3(rigid_c.t_m[0], rigid_c.t_m[1], rigid_c.t_m[2])};
}

sphc_rigid rigidToC(const Rigid &rigid) {
  sphc_rigid rigid_c;
  quaternionFromRotation(rigid.rotation, rigid_c.q_wxyz);
  for (int i = 0; i < 3; ++i) rigid_c.t_m[i] = rigid.translation_m[i];
  return rigid_c;
}

bool isValidRigid(const sphc_rigid &rigid_c) {
  double n = 0;
  for (double q : rigid_c.q_wxyz) n += q * q;
  if (!isFinite(n) || absOf(n - 1) > 2e-3) return false;
  for (double t : rigid_c.t_m)
    if (!isFinite(t)) return false;
  return true;
}

}  // namespace sphc
