// Robust least squares on the pose, the depth bias a nuisance: Gauss-Newton with Levenberg damping and the
// Geman-McClure loss, which lets go of outliers altogether (fake directions leak into slower-dying losses).
#pragma once
#include "runtime/base/deadline.h"
#include "runtime/stages/pose/kernels.h"
#include "runtime/types/depth_calibration.h"
#include "runtime/types/estimate.h"
#include "runtime/types/pose_prior.h"

namespace sphc {

using Matrix8 = Eigen::Matrix<double, kPoseUnknowns, kPoseUnknowns>;
using Vector8 = Eigen::Matrix<double, kPoseUnknowns, 1>;

constexpr double kFinalScale2 = 8;  // scale2 of the last refinement

// What a refinement changes.
struct PoseState {
  Rigid pose;                      // camera from map
  Vector2 bias = Vector2::Zero();  // of depth, beyond what is known: offset_m, slope
};
// By a turn and a shift in the camera frame, T = exp(xi) T_state, and a change of the bias.
PoseState moved(const PoseState &state, const Vector8 &step);

struct RefineTask {
  const PoseKernels *kernels;
  const PoseRows *lifted;
  const PoseRows *planes;  // rows taken for their epipolar planes; null: none
  const PosePrior *prior;  // its vertical is a soft term; null: none
  Deadline deadline;
  DepthCalibration depth;  // around zero: the rows have been corrected by its mean; known: not estimated
  double scale2;           // squared residual at which a row has lost three quarters of its weight
};

struct Refinement {
  Rigid camera_from_map;
  Vector2 bias = Vector2::Zero();         // what is left: offset_m, slope
  Matrix8 information = Matrix8::Zero();  // inverse covariance of the unknowns, priors included
  double cost = 0;                        // sum of the robust losses
};

// The task of the kernels at a pose and bias.
NormalTask normalTask(const RefineTask &task, const Rigid &pose, const Vector2 &bias);
// What a correspondence of this squared residual adds to the information of the last refinement, over what its
// errors would say: its robust weight, and the loss's efficiency.
double finalInformation(double squared);
// Gauss-Newton steps without looking back, and without the depth bias: local optimisation.
Rigid improvePose(const RefineTask &task, const Rigid &start, int steps);
// To convergence, at most `iterations`, and no longer than until the deadline.
Refinement refinePose(const RefineTask &task, const Rigid &start, int iterations);

}  // namespace sphc
