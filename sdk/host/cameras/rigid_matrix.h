// Rigid transforms as the quaternions and matrices that files hold.
#pragma once
#include <string>
#include <vector>

#include "spherecloud/spherecloud.h"

namespace sphc::host {

// Makes the quaternion one of unit length; false if it was further from it than `tolerance`.
bool normalizeQuaternion(double q_wxyz[4], double tolerance);
// False when `rows` (row-major 3 x 4 of a 4 x 4 matrix) is not finite or its left part no rotation.
bool rigidFromRows(const double rows[12], sphc_rigid *rigid);

// Nine numbers and three, row-major.  Empty and `rigid` set, or what is wrong; entries may be off by what a few
// printed digits lose, the nearest rotation is taken.
std::string rigidFromMatrix(const std::vector<double> &rotation, const std::vector<double> &t_m, sphc_rigid *rigid);

struct RigidMatrix {
  std::vector<double> rotation, t_m;  // row-major 3 x 3, and 3
};
RigidMatrix matrixFromRigid(const sphc_rigid &rigid);

sphc_rigid inverse(const sphc_rigid &rigid);

}  // namespace sphc::host
