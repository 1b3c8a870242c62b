#include "host/cameras/rigid_matrix.h"

#include <algorithm>
#include <cmath>

#include "host/cameras/number_text.h"

namespace sphc::host {
namespace {

constexpr double kRotationTolerance = 1e-2;  // of R R^T - I; recordings print six digits or more

bool isRotation(const double r[3][3]) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const double dot = r[i][0] * r[j][0] + r[i][1] * r[j][1] + r[i][2] * r[j][2];
      if (std::fabs(dot - (i == j ? 1.0 : 0.0)) > kRotationTolerance) return false;
    }
  const double determinant = r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1]) -
                             r[0][1] * (r[1][0] * r[2][2] - r[1][2] * r[2][0]) +
                             r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0]);
  return determinant > 0.0;
}

// Shepperd's method: divides by the largest of the four components.
void quaternionFromRotation(const double r[3][3], double q[4]) {
  const double trace = r[0][0] + r[1][1] + r[2][2];
  if (trace > 0.0) {
    const double s = 2.0 * std::sqrt(1.0 + trace);
    q[0] = 0.25 * s;
    q[1] = (r[2][1] - r[1][2]) / s;
    q[2] = (r[0][2] - r[2][0]) / s;
    q[3] = (r[1][0] - r[0][1]) / s;
    return;
  }
  int i = r[1][1] > r[0][0] ? 1 : 0;
  if (r[2][2] > r[i][i]) i = 2;
  const int j = (i + 1) % 3;
  const int k = (i + 2) % 3;
  const double s = 2.0 * std::sqrt(1.0 + r[i][i] - r[j][j] - r[k][k]);
  q[0] = (r[k][j] - r[j][k]) / s;
  q[1 + i] = 0.25 * s;
  q[1 + j] = (r[j][i] + r[i][j]) / s;
  q[1 + k] = (r[k][i] + r[i][k]) / s;
}

}  // namespace

bool normalizeQuaternion(double q_wxyz[4], double tolerance) {
  const double norm =
      std::sqrt(q_wxyz[0] * q_wxyz[0] + q_wxyz[1] * q_wxyz[1] + q_wxyz[2] * q_wxyz[2] + q_wxyz[3] * q_wxyz[3]);
  if (!(std::fabs(norm - 1.0) <= tolerance) || norm == 0.0) return false;
  // One that is unit to rounding keeps its bits, so that writing and reading does not wander.
  if (std::fabs(norm - 1.0) > 1e-15)
    for (int i = 0; i < 4; ++i) q_wxyz[i] /= norm;
  return true;
}

bool rigidFromRows(const double rows[12], sphc_rigid *rigid) {
  if (!std::all_of(rows, rows + 12, [](double x) { return std::isfinite(x); })) return false;
  double rotation[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) rotation[i][j] = rows[4 * i + j];
  if (!isRotation(rotation)) return false;
  quaternionFromRotation(rotation, rigid->q_wxyz);
  for (int i = 0; i < 3; ++i) rigid->t_m[i] = rows[4 * i + 3];
  return normalizeQuaternion(rigid->q_wxyz, 0.1);
}

std::string rigidFromMatrix(const std::vector<double> &rotation, const std::vector<double> &t_m,
                            sphc_rigid *rigid) {
  if (rotation.size() != 9)
    return "has a rotation of " + std::to_string(rotation.size()) + " numbers; must be 3 x 3";
  if (t_m.size() != 3)
    return "has a translation of " + std::to_string(t_m.size()) + " numbers; must be 3, in metres";
  const std::vector<double> &r = rotation;
  const double rows[12] = {r[0], r[1], r[2], t_m[0], r[3], r[4], r[5], t_m[1], r[6], r[7], r[8], t_m[2]};
  if (!rigidFromRows(rows, rigid))
    return "is no rotation (rows of unit length at right angles, determinant 1): " + numbersText(rotation) +
           "; check the order of the numbers";
  return {};
}

RigidMatrix matrixFromRigid(const sphc_rigid &rigid) {
  sphc_rigid rotation = rigid;
  std::fill_n(rotation.t_m, 3, 0.0);
  RigidMatrix result;
  result.rotation.resize(9);
  for (int j = 0; j < 3; ++j) {
    double axis[3] = {}, column[3];
    axis[j] = 1;
    sphc_rigid_apply(&rotation, axis, column);
    for (int i = 0; i < 3; ++i) result.rotation[3 * i + j] = column[i];
  }
  result.t_m.assign(rigid.t_m, rigid.t_m + 3);
  return result;
}

sphc_rigid inverse(const sphc_rigid &rigid) {
  sphc_rigid result;
  sphc_rigid_inverse(&rigid, &result);
  return result;
}

}  // namespace sphc::host
