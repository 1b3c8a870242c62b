// What the pose stage answers.
#pragma once
#include <cstdint>

#include "runtime/geometry/rigid.h"
#include "runtime/types/depth_calibration.h"

namespace sphc {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

enum class PoseEnding : uint8_t { kFound, kFewCorrespondences, kNoConsensus, kDeadline };

struct Estimate {
  PoseEnding ending = PoseEnding::kNoConsensus;
  bool cut_short = false;  // by the deadline: more time might find better
  Rigid camera_from_map;
  Matrix6 covariance = Matrix6::Zero();  // of (rotation rad, translation m), camera frame, T = exp(xi) T_estimate
  DepthCalibration depth;                // the query's, after this frame
  double noise_ratio = 0;                // depth noise seen over expected; 0: too little to tell
  double unit_variance = 1;              // of inliers: squared whitened residual over what was expected
  double gain = 0;                       // sum over inliers of 1 - residual^2 / threshold^2
  uint32_t inliers = 0;
  uint32_t lifted = 0;      // correspondences with depth
  uint32_t iterations = 0;  // minimal samples drawn
  uint32_t hypotheses = 0;  // poses they had
};

}  // namespace sphc
