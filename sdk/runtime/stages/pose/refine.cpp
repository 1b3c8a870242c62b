#include "runtime/stages/pose/refine.h"

#include <Eigen/Cholesky>

#include "runtime/stages/pose/residual.h"

namespace sphc {
namespace {

struct NormalEquations {
  Matrix6 matrix = Matrix6::Zero();
  Vector6 gradient = Vector6::Zero();
  double cost = 0;
};

NormalEquations linearise(Span<const Correspondence> correspondences, const Rigid &pose, double scale2) {
  NormalEquations sum;
  for (const Correspondence &c : correspondences) {
    const Residual r = residualOf(c, pose);
    if (!r.in_front || r.squared > 100 * scale2) {
      sum.cost += scale2;
      continue;
    }
    // Geman-McClure: loss = s / (1 + s / scale2), weight = its derivative
    const double fall = 1 / (1 + r.squared / scale2), weight = fall * fall;
    sum.cost += r.squared * fall;
    // Moving the pose by (omega, rho) moves the ray's foot by omega x foot + rho, the residual by minus W of that;
    // along the ray the residual is minimal already, so that part drops out.
    const Vector3 view = c.lifted.point_m.normalized();
    Eigen::Matrix<double, 3, 6> jacobian;
    for (int k = 0; k < 3; ++k) {
      const Vector3 axis = Vector3::Unit(k);
      jacobian.col(k) = -whiten(c.lifted, view, axis.cross(r.foot_m));
      jacobian.col(3 + k) = -whiten(c.lifted, view, axis);
    }
    jacobian -= r.ray_whitened * (r.ray_whitened.transpose() * jacobian);
    sum.matrix.noalias() += weight * jacobian.transpose() * jacobian;
    sum.gradient.noalias() += weight * jacobian.transpose() * r.whitened;
  }
  return sum;
}

Rigid moved(const Rigid &pose, const Vector6 &step) {
  const Matrix3 turn = rotationFromVector(step.head<3>());
  return {turn * pose.rotation, turn * pose.translation_m + step.tail<3>()};
}

}  // namespace

Refinement refinePose(Span<const Correspondence> correspondences, const Rigid &start, double scale2,
                      int iterations) {
  Rigid pose = start;
  NormalEquations now = linearise(correspondences, pose, scale2);
  double damping = 1e-4;
  for (int i = 0; i < iterations; ++i) {
    Matrix6 damped = now.matrix;
    damped.diagonal() *= 1 + damping;
    damped.diagonal().array() += 1e-9;
    const Vector6 step = -damped.ldlt().solve(now.gradient);
    if (!isFinite(step.sum())) break;
    const Rigid next = moved(pose, step);
    const NormalEquations there = linearise(correspondences, next, scale2);
    if (there.cost < now.cost) {
      pose = next;
      now = there;
      damping *= 0.1;
      if (step.squaredNorm() < 1e-14) break;
    } else {
      if (step.squaredNorm() < 1e-14) break;
      damping = damping * 100 + 1e-3;
    }
  }
  return {pose, now.matrix, now.cost};
}

}  // namespace sphc
