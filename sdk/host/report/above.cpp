#include "host/report/above.h"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace sphc::host {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Vector3d upward(const std::vector<sphc_rigid> &poses) {
  Vector3d sum = Vector3d::Zero();
  for (const sphc_rigid &pose : poses) {
    const double *q = pose.q_wxyz;
    sum -= Eigen::Quaterniond(q[0], q[1], q[2], q[3]) * Vector3d::UnitY();  // OpenCV's y points down
  }
  if (sum.norm() < 0.1 * static_cast<double>(poses.size()) || poses.empty()) return Vector3d::UnitZ();
  Vector3d up = sum.normalized();
  // A world with an axis close by was almost surely made with that axis up.
  Vector3d::Index axis = 0;
  if (up.cwiseAbs().maxCoeff(&axis) > 0.9) up = Vector3d::Unit(axis) * (up[axis] > 0 ? 1 : -1);
  return up;
}

// Direction of the largest spread, in the plane of `a` and `b`.
Vector2d longestExtent(const std::vector<sphc_rigid> &poses, const Vector3d &a, const Vector3d &b) {
  Vector2d mean = Vector2d::Zero();
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const sphc_rigid &pose : poses) {
    const Vector3d p(pose.t_m[0], pose.t_m[1], pose.t_m[2]);
    const Vector2d flat(a.dot(p), b.dot(p));
    mean += flat;
    spread += flat * flat.transpose();
  }
  const double count = static_cast<double>(poses.size());
  spread -= mean * mean.transpose() / count;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(spread);
  Vector2d longest = solver.eigenvectors().col(1);
  return longest.x() < 0 ? Vector2d(-longest) : longest;
}

}  // namespace

std::array<double, 2> AboveView::project(const double p[3]) const {
  return {right[0] * p[0] + right[1] * p[1] + right[2] * p[2], up[0] * p[0] + up[1] * p[1] + up[2] * p[2]};
}

AboveView viewFromAbove(const std::vector<sphc_rigid> &poses) {
  const Vector3d sky = upward(poses);
  const Vector3d seed = std::abs(sky.x()) < 0.9 ? Vector3d::UnitX() : Vector3d::UnitY();
  const Vector3d a = (seed - seed.dot(sky) * sky).normalized(), b = sky.cross(a);
  const Vector2d longest = poses.size() > 1 ? longestExtent(poses, a, b) : Vector2d(1, 0);
  const Vector3d right = longest.x() * a + longest.y() * b, up = sky.cross(right);
  AboveView view;
  for (int i = 0; i < 3; ++i) {
    view.right[static_cast<size_t>(i)] = right[i];
    view.up[static_cast<size_t>(i)] = up[i];
  }
  return view;
}

}  // namespace sphc::host
