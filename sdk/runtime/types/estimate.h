// What the pose stage answers.
#pragma once
#include <cstdint>

#include "runtime/geometry/rigid.h"

namespace sphc {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

struct Estimate {
  Rigid camera_from_map;
  Matrix6 covariance = Matrix6::Zero();  // of (rotation rad, translation m), camera frame, T = exp(xi) T_estimate
  uint32_t inliers = 0;
  uint32_t iterations = 0;
};

}  // namespace sphc
