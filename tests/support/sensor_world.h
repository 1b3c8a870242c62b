// Correspondences of a simulated depth camera whose every error is known: what it measures, what it states of its
// noise, and the pose that is true.
#pragma once
#include "runtime/types/pose_prior.h"
#include "tests/support/pose_world.h"

namespace sphc::test {

struct SensorWorldOptions {
  uint64_t seed = 1;
  size_t count = 300;          // correspondences, true and false together
  double true_share = 1;       // of them whose direction is that of their point; the rest point anywhere
  double depthless_share = 0;  // of them that have no depth
  double pixel_sigma_px = 0.8, map_sigma_m = 0.003;
  double depth_sigma_m = 0.002, depth_sigma_per_m2 = 0.003;  // sigma of z: the first and z^2 times the second
  double stated_depth_noise = 1;                             // over the true one
  double mid_m = 2;
  Vector2 bias = Vector2::Zero();    // offset_m at mid_m, slope: z = measured + offset + slope (measured - mid)
  bool states_from_truth = false;    // errors are stated for the true point, not for the measured one
  bool informative_quality = false;  // true matches have a higher quality, mostly
};

PoseWorld makeSensorWorld(const SensorWorldOptions &options);

// The prior that an odometer (errors drawn from its sigmas) or an accelerometer would give.
PosePrior odometerPrior(const PoseWorld &world, double rotation_sigma_rad, double translation_sigma_m,
                        uint64_t seed);
PosePrior gravityPrior(const PoseWorld &world, double up_sigma_rad, uint64_t seed);

// xi of T_true = exp(xi) T_estimate: rotation rad, translation m; the frame of Estimate::covariance.
Vector6 poseError(const Rigid &estimate, const Rigid &truth);

}  // namespace sphc::test
