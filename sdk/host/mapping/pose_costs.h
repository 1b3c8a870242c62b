// Residuals of a pose graph for Ceres: how far poses are from what is known of them, in sigmas.  Blocks are
// camera_from_world (pose_block.h).  A residual is the rotation vector and the translation of what is left over
// (Grisetti, Kuemmerle, Stachniss, Burgard, "A tutorial on graph-based SLAM", 2010).
#pragma once
#include <ceres/sized_cost_function.h>

#include "host/mapping/frame_links.h"

namespace sphc::host {

// Blocks: the frames a and b of a link.
class LinkCost : public ceres::SizedCostFunction<6, 7, 7> {
 public:
  explicit LinkCost(const FrameLink &link);
  bool Evaluate(double const *const *blocks, double *residuals, double **jacobians) const override;

 private:
  Rigid b_from_a_, a_from_b_;
  Matrix6 whiten_;
};

// Block: a frame whose pose is known to so many metres and radians, 1 sigma along each axis.
class AnchorCost : public ceres::SizedCostFunction<6, 7> {
 public:
  AnchorCost(const Rigid &world_from_camera, double sigma_m, double sigma_rad);
  bool Evaluate(double const *const *blocks, double *residuals, double **jacobians) const override;

 private:
  Rigid world_from_camera_;
  Vector6 weight_;
};

}  // namespace sphc::host
