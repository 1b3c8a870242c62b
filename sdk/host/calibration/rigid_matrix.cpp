#include "host/calibration/rigid_matrix.h"

#include "host/calibration/number_text.h"
#include "host/recording/pose_track.h"
#include "runtime/geometry/rotation.h"

namespace sphc::host {

std::string rigidFromMatrix(const std::vector<double> &rotation, const std::vector<double> &t_m,
                            sphc_rigid *rigid) {
  if (rotation.size() != 9)
    return "has a rotation of " + std::to_string(rotation.size()) + " numbers; must be 3 x 3";
  if (t_m.size() != 3)
    return "has a translation of " + std::to_string(t_m.size()) + " numbers; must be 3, in metres";
  const std::vector<double> &r = rotation;
  const double rows[12] = {r[0], r[1], r[2], t_m[0], r[3], r[4], r[5], t_m[1], r[6], r[7], r[8], t_m[2]};
  if (!recording::rigidFromMatrix(rows, *rigid))
    return "is no rotation (rows of unit length at right angles, determinant 1): " + numbersText(rotation) +
           "; check the order of the numbers";
  return {};
}

RigidMatrix matrixFromRigid(const sphc_rigid &rigid) {
  const Matrix3 rotation = rotationFromQuaternion(rigid.q_wxyz);
  RigidMatrix result;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) result.rotation.push_back(rotation(i, j));
  result.t_m.assign(rigid.t_m, rigid.t_m + 3);
  return result;
}

sphc_rigid inverse(const sphc_rigid &rigid) {
  sphc_rigid result;
  sphc_rigid_inverse(&rigid, &result);
  return result;
}

}  // namespace sphc::host
