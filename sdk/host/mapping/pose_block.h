// A pose as Ceres adjusts it: seven numbers (unit quaternion w x y z, translation in metres) that move by six, a
// rotation vector and a shift in the camera's frame, T = exp(xi) T.
#pragma once
#include <ceres/manifold.h>

#include <array>

#include "runtime/geometry/rigid.h"

namespace sphc::host {

using PoseBlock = std::array<double, 7>;

PoseBlock blockFrom(const Rigid &pose);
Rigid poseFrom(const double *block);

// Residuals give their derivatives by the six in the first six columns of the block, and zero in the last.  So no
// residual has to differentiate a quaternion.
class PoseManifold : public ceres::Manifold {
 public:
  int AmbientSize() const override { return 7; }
  int TangentSize() const override { return 6; }
  bool Plus(const double *x, const double *delta, double *x_plus_delta) const override;
  bool PlusJacobian(const double *x, double *jacobian) const override;
  bool Minus(const double *y, const double *x, double *y_minus_x) const override;
  bool MinusJacobian(const double *x, double *jacobian) const override;
};

}  // namespace sphc::host
