// A path beside the true one.
#pragma once
#include <cstdint>
#include <vector>

#include "runtime/geometry/rigid.h"

namespace sphc::host {

// The same camera, in the world of the estimate and in the true one.
struct PosePair {
  Rigid estimated, truth;  // world_from_camera
};

struct TrajectoryScore {
  size_t frames = 0;
  Rigid true_from_estimated;     // world to world, least squares over the cameras' places (Umeyama 1991)
  double rigid_rmse_m = 0;       // of the places after it: the absolute trajectory error
  double rigid_worst_m = 0;      // of one place
  double similarity_rmse_m = 0;  // the same after the best scale too
  double scale = 1;              // a true metre as the estimate has it
  double rotation_median_deg = 0, rotation_worst_deg = 0;  // after the rigid alignment
};

// Throws std::runtime_error for fewer than three poses.
TrajectoryScore scoreTrajectory(const std::vector<PosePair> &poses);

}  // namespace sphc::host
