#include "host/mapping/adjustment_costs.h"

#include <algorithm>

#include "host/mapping/pose_block.h"

namespace sphc::host {
namespace {

using Row3 = Eigen::Matrix<double, 1, 3>;
using Matrix23 = Eigen::Matrix<double, 2, 3, Eigen::RowMajor>;

// d(point in the camera) / d(motion of the camera): rotation, shift.
Eigen::Matrix<double, 3, 6> motionOf(const Vector3 &point_m) {
  Eigen::Matrix<double, 3, 6> motion;
  motion << -crossMatrix(point_m), Matrix3::Identity();
  return motion;
}

template <int kRows>
void putPose(const Eigen::Matrix<double, kRows, 3, Eigen::RowMajor> &by_point, const Vector3 &point_m,
             double *out) {
  Eigen::Map<Eigen::Matrix<double, kRows, 7, Eigen::RowMajor>> jacobian(out);
  jacobian.template leftCols<6>() = by_point * motionOf(point_m);
  jacobian.col(6).setZero();
}

}  // namespace

bool RayCost::Evaluate(double const *const *blocks, double *residuals, double **jacobians) const {
  const Rigid camera_from_world = poseFrom(blocks[1]);
  const Vector3 point_m = camera_from_world * Eigen::Map<const Vector3>(blocks[0]);
  const double z = std::max(point_m.z(), kNearestM);
  const Vector2 ray = point_m.head<2>() / z;
  Eigen::Map<Vector2> residual(residuals);
  residual = weight_ * (assumedRay(ray, blocks[2]) - ray_);
  if (!jacobians) return true;
  Matrix23 by_point;
  by_point << 1, 0, -ray.x(), 0, 1, -ray.y();
  by_point *= (1 + blocks[2][0]) * weight_ / z;
  if (jacobians[0]) Eigen::Map<Matrix23>(jacobians[0]).noalias() = by_point * camera_from_world.rotation;
  if (jacobians[1]) putPose<2>(by_point, point_m, jacobians[1]);
  if (jacobians[2]) {
    Eigen::Map<Matrix23> by_lens(jacobians[2]);
    by_lens << ray.x(), 1, 0, ray.y(), 0, 1;
    by_lens *= weight_;
  }
  return true;
}

DepthMeasurement measurementOf(double true_m, const double *bias, double mid_m) {
  const double by_depth = 1 / (1 + bias[1]), depth_m = (true_m - bias[0] + bias[1] * mid_m) * by_depth;
  return {depth_m, by_depth, -by_depth, (mid_m - depth_m) * by_depth};
}

bool DepthCost::Evaluate(double const *const *blocks, double *residuals, double **jacobians) const {
  const Rigid camera_from_world = poseFrom(blocks[1]);
  const Vector3 point_m = camera_from_world * Eigen::Map<const Vector3>(blocks[0]);
  const DepthMeasurement expected = measurementOf(point_m.z(), blocks[2], mid_m_);
  residuals[0] = weight_ * (expected.depth_m - depth_m_ - by_mount_.dot(Eigen::Map<const Vector5>(blocks[3])));
  if (!jacobians) return true;
  const Row3 by_point = weight_ * expected.by_depth * Row3::UnitZ();
  if (jacobians[0]) Eigen::Map<Row3>(jacobians[0]).noalias() = by_point * camera_from_world.rotation;
  if (jacobians[1]) putPose<1>(by_point, point_m, jacobians[1]);
  if (jacobians[2]) {
    jacobians[2][0] = weight_ * expected.by_offset;
    jacobians[2][1] = weight_ * expected.by_slope;
  }
  if (jacobians[3]) {
    Eigen::Map<Vector5> by_mount(jacobians[3]);
    by_mount = -weight_ * by_mount_;
  }
  return true;
}

}  // namespace sphc::host
