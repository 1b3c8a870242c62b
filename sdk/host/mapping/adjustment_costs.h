// Residuals of a sighting for Ceres, in sigmas: where its keypoint lies, and how deep it is.
#pragma once
#include <ceres/sized_cost_function.h>

#include "host/mapping/calibration_change.h"

namespace sphc::host {

constexpr double kNearestM = 0.05;  // of a point before the camera, so that it can be divided by

// Blocks: point in the world, camera_from_world, what the lens is off.
class RayCost : public ceres::SizedCostFunction<2, 3, 7, 3> {
 public:
  explicit RayCost(const SeenPoint &seen) : ray_(seen.ray), weight_(1 / seen.sigma) {}

  bool Evaluate(double const *const *blocks, double *residuals, double **jacobians) const override;

 private:
  Vector2 ray_;
  double weight_;
};

// What the sensor would measure of a true depth, and its derivative by that depth and by (offset_m, slope).
struct DepthMeasurement {
  double depth_m, by_depth, by_offset, by_slope;
};
DepthMeasurement measurementOf(double true_m, const double *bias, double mid_m);

// Blocks: point in the world, camera_from_world, offset and slope of the depths, how the depth sensor is off its
// place.  The residual is in the sensor's own measure: were measurements corrected in place, a shorter world would
// have shorter residuals, and would shrink.
class DepthCost : public ceres::SizedCostFunction<1, 3, 7, 2, 5> {
 public:
  DepthCost(const SeenPoint &seen, double mid_m)
      : depth_m_(seen.depth_m), by_mount_(depthByMount(seen)), mid_m_(mid_m), weight_(1 / seen.depth_sigma_m) {}

  bool Evaluate(double const *const *blocks, double *residuals, double **jacobians) const override;

 private:
  double depth_m_;
  Vector5 by_mount_;
  double mid_m_, weight_;
};

}  // namespace sphc::host
