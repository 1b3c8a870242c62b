#include "host/mapping/pose_costs.h"

#include "host/mapping/pose_block.h"

namespace sphc::host {
namespace {

using Matrix67 = Eigen::Matrix<double, 6, 7, Eigen::RowMajor>;

// A link is never surer than this: its depths share a bias, and its matches one image.
constexpr double kLeastRad = 0.002, kLeastM = 0.004;

Matrix6 floored(Matrix6 covariance) {
  covariance.diagonal().head<3>().array() += kLeastRad * kLeastRad;
  covariance.diagonal().tail<3>().array() += kLeastM * kLeastM;
  return covariance;
}

// Of a motion that should be none.
Vector6 errorOf(const Rigid &motion) {
  Vector6 error;
  error << vectorFromRotation(motion.rotation), motion.translation_m;
  return error;
}

// How a small motion of a frame's camera moves the error.
Matrix6 motionOfError(const Rigid &error) {
  Matrix6 motion = Matrix6::Identity();
  motion.topLeftCorner<3, 3>() -= 0.5 * crossMatrix(vectorFromRotation(error.rotation));
  motion.bottomLeftCorner<3, 3>() = -crossMatrix(error.translation_m);
  return motion;
}

// T exp(xi) = exp(adjoint(T) xi) T
Matrix6 adjoint(const Rigid &pose) {
  Matrix6 result = Matrix6::Zero();
  result.topLeftCorner<3, 3>() = result.bottomRightCorner<3, 3>() = pose.rotation;
  result.bottomLeftCorner<3, 3>() = crossMatrix(pose.translation_m) * pose.rotation;
  return result;
}

void put(const Matrix6 &derivative, double *out) {
  Eigen::Map<Matrix67> jacobian(out);
  jacobian.leftCols<6>() = derivative;
  jacobian.col(6).setZero();
}

}  // namespace

LinkCost::LinkCost(const FrameLink &link) : b_from_a_(link.b_from_a), a_from_b_(link.b_from_a.inverse()) {
  whiten_ = floored(link.covariance).inverse().llt().matrixU();
}

bool LinkCost::Evaluate(double const *const *blocks, double *residuals, double **jacobians) const {
  const Rigid error = poseFrom(blocks[1]) * poseFrom(blocks[0]).inverse() * a_from_b_;
  Eigen::Map<Vector6> residual(residuals);
  residual = whiten_ * errorOf(error);
  if (!jacobians) return true;
  const Matrix6 by_b = whiten_ * motionOfError(error);
  if (jacobians[1]) put(by_b, jacobians[1]);
  if (jacobians[0]) put(-by_b * adjoint(error * b_from_a_), jacobians[0]);
  return true;
}

AnchorCost::AnchorCost(const Rigid &world_from_camera, double sigma_m, double sigma_rad)
    : world_from_camera_(world_from_camera) {
  weight_ << Vector3::Constant(1 / sigma_rad), Vector3::Constant(1 / sigma_m);
}

bool AnchorCost::Evaluate(double const *const *blocks, double *residuals, double **jacobians) const {
  const Rigid error = poseFrom(blocks[0]) * world_from_camera_;
  Eigen::Map<Vector6> residual(residuals);
  residual = weight_.asDiagonal() * errorOf(error);
  if (jacobians && jacobians[0]) put(weight_.asDiagonal() * motionOfError(error), jacobians[0]);
  return true;
}

}  // namespace sphc::host
