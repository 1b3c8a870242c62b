// What is known of how a depth sensor's measurements are off: true z = z + offset_m + slope (z - mid_m), and its
// noise is `noise_scale` times the stated one.
//
// Map directions see only the offset that is left once a common scale is taken away: a common scale of all depths
// moves the camera along with them.  With the offset stated at mid range, "right at mid range" fixes that scale,
// and offset and slope can have independent priors; stated at zero depth the same belief would be a correlated one.
#pragma once
#include <Eigen/Core>

#include "runtime/geometry/rotation.h"

namespace sphc {

using Matrix2 = Eigen::Matrix2d;

constexpr double kLeastNoiseScale = 0.25, kMostNoiseScale = 4;  // that are learnt

struct DepthCalibration {
  double mid_m = 0;
  Vector2 mean = Vector2::Zero();        // offset_m, slope
  Matrix2 covariance = Matrix2::Zero();  // zero: known exactly, not estimated
  double noise_scale = 1;

  double correctionAt(double z_m) const { return mean[0] + mean[1] * (z_m - mid_m); }
  bool isKnown() const { return !(covariance(0, 0) > 0); }
};

}  // namespace sphc
