#include "host/report/top_view.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "host/report/directions.h"

namespace sphc::host {
namespace {

using Vector = std::array<double, 3>;

Vector cross(const Vector &a, const Vector &b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// a x + b y
Vector mix(double a, const Vector &x, double b, const Vector &y) {
  return {a * x[0] + b * y[0], a * x[1] + b * y[1], a * x[2] + b * y[2]};
}

Vector unit(const Vector &v) { return mix(1 / std::sqrt(dotProduct(v, v)), v, 0, v); }

Vector axis(size_t index, double sign) {
  Vector v = {};
  v[index] = sign;
  return v;
}

Vector upward(const std::vector<sphc_rigid> &poses) {
  Vector sum = {};
  for (const sphc_rigid &pose : poses) {
    const double *q = pose.q_wxyz;
    // Second column of the rotation matrix, negative: OpenCV's y points down.
    sum[0] -= 2 * (q[1] * q[2] - q[0] * q[3]);
    sum[1] -= 1 - 2 * (q[1] * q[1] + q[3] * q[3]);
    sum[2] -= 2 * (q[2] * q[3] + q[0] * q[1]);
  }
  if (poses.empty() || std::sqrt(dotProduct(sum, sum)) < 0.1 * static_cast<double>(poses.size())) return axis(2, 1);
  return unit(sum);
}

struct UpAxis {
  size_t index = 0;
  bool is_negative = false;
};

// A world with an axis close by was almost surely made with that axis up.  Not so -y: where the first camera is the
// world, -y is always close by, and as far from up as that camera was tilted.
std::optional<UpAxis> axisNear(const Vector &up) {
  constexpr double kNearCosine = 0.9, kNearCosineOfMinusY = 0.9962;  // 26 and 5 degrees
  for (size_t i = 0; i < 3; ++i)
    if (std::abs(up[i]) > (i == 1 && up[i] < 0 ? kNearCosineOfMinusY : kNearCosine)) return UpAxis{i, up[i] < 0};
  return std::nullopt;
}

// Angle from `a` towards `b` of the direction in which the poses are spread most.
double longestExtent(const std::vector<sphc_rigid> &poses, const Vector &a, const Vector &b) {
  double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  const double count = static_cast<double>(std::max<size_t>(1, poses.size()));
  for (const sphc_rigid &pose : poses) {
    const Vector p = {pose.t_m[0], pose.t_m[1], pose.t_m[2]};
    const double u = dotProduct(a, p), v = dotProduct(b, p);
    x += u / count;
    y += v / count;
    xx += u * u / count;
    xy += u * v / count;
    yy += v * v / count;
  }
  return std::atan2(2 * (xy - x * y), (xx - x * x) - (yy - y * y)) / 2;  // in -90 to 90 degrees
}

}  // namespace

std::array<double, 2> TopView::project(const double p[3]) const {
  return {right[0] * p[0] + right[1] * p[1] + right[2] * p[2], up[0] * p[0] + up[1] * p[1] + up[2] * p[2]};
}

TopView topView(const std::vector<sphc_rigid> &poses) {
  TopView view;
  const Vector sky = upward(poses);
  if (const std::optional<UpAxis> axis_up = axisNear(sky)) {
    // The other two in their own directions, so that places are those of the base: right x up points to the sky.
    const size_t next = (axis_up->index + 1) % 3, last = (axis_up->index + 2) % 3;
    view.right = axis(axis_up->is_negative ? last : next, 1);
    view.up = axis(axis_up->is_negative ? next : last, 1);
    return view;
  }
  view.is_up_an_axis = false;
  const Vector seed = axis(std::abs(sky[0]) < 0.9 ? 0 : 1, 1);
  const Vector a = unit(mix(1, seed, -dotProduct(seed, sky), sky)), b = cross(sky, a);
  const double turn = poses.size() > 1 ? longestExtent(poses, a, b) : 0;
  view.right = mix(std::cos(turn), a, std::sin(turn), b);
  view.up = cross(sky, view.right);
  return view;
}

}  // namespace sphc::host
