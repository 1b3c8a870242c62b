// A path beside the true one.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/geometry/rigid.h"

namespace sphc::host {

// The same camera, in the world (or other base) of the estimate and in the true one.
struct PosePair {
  Rigid estimated, truth;  // base_from_camera
};

struct TrajectoryScore {
  size_t frames = 0;
  Rigid true_from_estimated;  // world to world, least squares over the cameras' places (Umeyama 1991)
  double rigid_rmse_m = 0;    // of the places after it: the absolute trajectory error
  double rigid_worst_m = 0;   // of one place
  // Where the path comes back to within half a metre of itself, after five metres or more: how far two such places
  // are off beside each other, at worst; none where it does not.
  std::optional<double> revisit_worst_m;
  double similarity_rmse_m = 0;                            // the same after the best scale too
  double scale = 1;                                        // a true metre as the estimate has it
  double rotation_median_deg = 0, rotation_worst_deg = 0;  // after the rigid alignment
};

constexpr size_t kFewestScored = 3;

// In the order of the path.  Throws std::runtime_error for fewer than kFewestScored poses.
TrajectoryScore scoreTrajectory(const std::vector<PosePair> &poses);

// Whether the truth is given as its inverse, camera_from_base: turned round, it fits far better.  Of as many poses.
bool isTruthInverse(const std::vector<PosePair> &poses);

}  // namespace sphc::host
