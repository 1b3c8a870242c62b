// Bundle adjustment (Triggs, McLauchlan, Hartley, Fitzgibbon 2000) with depth: poses, points, the depth sensor's
// bias and, where asked, the calibration, from where keypoints lie and how deep they are.
#pragma once
#include <vector>

#include "host/mapping/calibration_change.h"
#include "host/mapping/pose_beliefs.h"
#include "host/mapping/tracks.h"
#include "runtime/types/depth_calibration.h"

namespace sphc::host {

struct AdjustmentOptions {
  int most_steps = 20;
  const PoseBeliefs *beliefs = nullptr;              // of the poses; null: none
  bool poses_are_held = false;                       // where they are; points and the bias alone are adjusted
  bool lens_is_free = false, mount_is_free = false;  // of the calibration
  CalibrationChange change_so_far = {};              // what it was changed by before, which the prior counts
};

struct AdjustmentSummary {
  size_t points = 0, sightings = 0;
  double ray_sigmas = 0;    // median length of the residuals of rays, in sigmas; 1.18 is what noise gives
  double depth_sigmas = 0;  // median size of those of depths; 0.67
  double depth_off_m = 0;   // median size of what depths are off, metres
  double far_depths = 0;    // share of depths that are off by more than 3 sigma
};

// What is adjusted: where it begins, and where it ends.
struct Adjusted {
  FramePoses world_from_camera;
  std::vector<Track> tracks;       // sightings that are far off in the end leave them
  Vector2 bias = Vector2::Zero();  // of depths: offset_m, slope, as in DepthCalibration
  CalibrationChange change;
};

// `prior`: what is believed of the depth sensor.  Where no belief holds the world, the first frame with a
// pose stays where it is.
AdjustmentSummary adjust(const std::vector<WalkFrame> &frames, const DepthCalibration &prior,
                         const AdjustmentOptions &options, Adjusted *adjusted);

}  // namespace sphc::host
