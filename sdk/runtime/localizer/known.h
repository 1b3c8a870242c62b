// What the caller knows of a frame before it is looked at, in the library's own types.
#pragma once
#include "runtime/types/pose_prior.h"
#include "spherecloud/spherecloud.h"

namespace sphc {

// The device's own dead reckoning: where the camera is in a frame that drifts.
struct Odometry {
  Rigid odometry_from_camera;
  double rotation_sigma_rad = 0, translation_sigma_m = 0;  // 1 sigma an axis, of the step from the frame before
};

struct Known {
  PosePrior prior;
  uint32_t map = 0;  // whose frame the prior's pose and vertical are in
  bool has_odometry = false;
  Odometry odometry;
};

// `given` may be null: nothing is known.
Known knownFromDoor(const sphc_prior *given);

}  // namespace sphc
