#include "runtime/geometry/rotation.h"

#include <algorithm>
#include <limits>

namespace sphc {

namespace {

constexpr double kLeastSquare = 1e-200, kMostSquare = 1e200;

// Of numbers whose squares vanish or overflow, or are none: as numbers of ordinary size.
Matrix3 rotationFromExtreme(const double q_wxyz[4]) {
  double largest = 0, scaled[4];
  for (int i = 0; i < 4; ++i) {
    if (!isFinite(q_wxyz[i])) return Matrix3::Constant(std::numeric_limits<double>::quiet_NaN());
    largest = std::max(largest, absOf(q_wxyz[i]));
  }
  if (largest == 0) return Matrix3::Identity();
  for (int i = 0; i < 4; ++i) scaled[i] = q_wxyz[i] / largest;
  return rotationFromQuaternion(scaled);
}

}  // namespace

Matrix3 rotationFromQuaternion(const double q_wxyz[4]) {
  const double n = q_wxyz[0] * q_wxyz[0] + q_wxyz[1] * q_wxyz[1] + q_wxyz[2] * q_wxyz[2] + q_wxyz[3] * q_wxyz[3];
  if (!(n >= kLeastSquare && n <= kMostSquare)) return rotationFromExtreme(q_wxyz);
  const double s = 2 / n, w = q_wxyz[0], x = q_wxyz[1], y = q_wxyz[2], z = q_wxyz[3];
  Matrix3 r;
  r << 1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y),  //
      s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x),   //
      s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y);
  return r;
}

void quaternionFromRotation(const Matrix3 &r, double q_wxyz[4]) {
  const double squares[4] = {1 + r(0, 0) + r(1, 1) + r(2, 2), 1 + r(0, 0) - r(1, 1) - r(2, 2),
                             1 - r(0, 0) + r(1, 1) - r(2, 2), 1 - r(0, 0) - r(1, 1) + r(2, 2)};  // 4 q_i^2
  int largest = 0;
  for (int i = 1; i < 4; ++i)
    if (squares[i] > squares[largest]) largest = i;
  const double product[4][4] = {// 4 q_i q_j
                                {squares[0], r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1)},
                                {r(2, 1) - r(1, 2), squares[1], r(1, 0) + r(0, 1), r(0, 2) + r(2, 0)},
                                {r(0, 2) - r(2, 0), r(1, 0) + r(0, 1), squares[2], r(2, 1) + r(1, 2)},
                                {r(1, 0) - r(0, 1), r(0, 2) + r(2, 0), r(2, 1) + r(1, 2), squares[3]}};
  double norm = 0;
  for (int i = 0; i < 4; ++i) norm += product[largest][i] * product[largest][i];
  const double scale = (product[largest][0] < 0 ? -1 : 1) / sqrtOf(norm);
  for (int i = 0; i < 4; ++i) q_wxyz[i] = product[largest][i] * scale;
}

Matrix3 rotationFromVector(const Vector3 &rotation_rad) {
  const double angle = sqrtOf(rotation_rad.squaredNorm());
  const Matrix3 k = crossMatrix(rotation_rad);
  if (angle < 1e-8) return Matrix3::Identity() + k + 0.5 * (k * k);
  double s, c;
  sinCos(angle, &s, &c);
  return Matrix3::Identity() + (s / angle) * k + ((1 - c) / (angle * angle)) * (k * k);
}

Vector3 vectorFromRotation(const Matrix3 &rotation) {
  double q[4];
  quaternionFromRotation(rotation, q);
  const Vector3 axis(q[1], q[2], q[3]);
  const double sine = axis.norm();
  return sine > 1e-12 ? Vector3(2 * atan2Of(sine, q[0]) / sine * axis) : Vector3(2 * axis);
}

double rotationAngle(const Matrix3 &r) {
  const Vector3 twice_sine(r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1));
  return atan2Of(sqrtOf(twice_sine.squaredNorm()), r.trace() - 1);
}

double angleBetween(const Vector3 &a, const Vector3 &b) { return atan2Of(a.cross(b).norm(), a.dot(b)); }

}  // namespace sphc
