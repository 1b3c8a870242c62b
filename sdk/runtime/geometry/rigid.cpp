#include "runtime/geometry/rigid.h"

namespace sphc {

Rigid rigidFromDoor(const sphc_rigid &door) {
  return {rotationFromQuaternion(door.q_wxyz), Vector3(door.t_m[0], door.t_m[1], door.t_m[2])};
}

sphc_rigid doorFromRigid(const Rigid &rigid) {
  sphc_rigid door;
  quaternionFromRotation(rigid.rotation, door.q_wxyz);
  for (int i = 0; i < 3; ++i) door.t_m[i] = rigid.translation_m[i];
  return door;
}

bool isValidRigid(const sphc_rigid &door) {
  double n = 0;
  for (double q : door.q_wxyz) n += q * q;
  if (!isFinite(n) || absOf(n - 1) > 2e-3) return false;
  for (double t : door.t_m)
    if (!isFinite(t)) return false;
  return true;
}

}  // namespace sphc
