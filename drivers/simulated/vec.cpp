#include "drivers/simulated/vec.h"

namespace sphc::simulated {

Mat3d matrixOf(const double q_wxyz[4]) {
  const double w = q_wxyz[0], x = q_wxyz[1], y = q_wxyz[2], z = q_wxyz[3];
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
           {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
           {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
}

namespace {

// The quaternion of a rotation matrix, real part >= 0.  The largest component is found from the diagonal and the
// others from it, so that nothing small is divided by.
void quaternionOf(const Mat3d &m, double q[4]) {
  const double d0 = m.row[0].x, d1 = m.row[1].y, d2 = m.row[2].z;
  const double four_sq[4] = {1 + d0 + d1 + d2, 1 + d0 - d1 - d2, 1 - d0 + d1 - d2, 1 - d0 - d1 + d2};
  int big = 0;
  for (int i = 1; i < 4; ++i) {
    if (four_sq[i] > four_sq[big]) big = i;
  }
  const double wx = m.row[2].y - m.row[1].z, wy = m.row[0].z - m.row[2].x, wz = m.row[1].x - m.row[0].y;
  const double xy = m.row[0].y + m.row[1].x, xz = m.row[0].z + m.row[2].x, yz = m.row[1].z + m.row[2].y;
  const double products[4][4] = {
      {four_sq[0], wx, wy, wz}, {wx, four_sq[1], xy, xz}, {wy, xy, four_sq[2], yz}, {wz, xz, yz, four_sq[3]}};
  double length = 0;
  for (double p : products[big]) length += p * p;
  const double scale = (products[big][0] < 0 ? -1.0 : 1.0) / std::sqrt(length);
  for (int i = 0; i < 4; ++i) q[i] = products[big][i] * scale;
}

}  // namespace

sphc_rigid rigidOf(const Pose &pose) {
  sphc_rigid rigid{};
  quaternionOf(pose.rotation, rigid.q_wxyz);
  rigid.t_m[0] = pose.center.x;
  rigid.t_m[1] = pose.center.y;
  rigid.t_m[2] = pose.center.z;
  return rigid;
}

Pose poseOf(const sphc_rigid &rigid) {
  return {matrixOf(rigid.q_wxyz), {rigid.t_m[0], rigid.t_m[1], rigid.t_m[2]}};
}

Pose compose(const Pose &a_from_b, const Pose &b_from_c) {
  return {a_from_b.rotation * b_from_c.rotation, a_from_b.rotation * b_from_c.center + a_from_b.center};
}

}  // namespace sphc::simulated
