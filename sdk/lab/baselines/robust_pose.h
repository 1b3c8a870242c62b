// LO-RANSAC for camera poses (Chum, Matas, Kittler, DAGM 2003), one for all baselines: what is matched with what is
// the problem's own affair.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "runtime/base/random.h"
#include "runtime/geometry/rigid.h"

namespace sphc::host {

// Gauss-Newton equations of a pose's small change: rotation vector, then translation, both in the camera frame.
struct PoseEquations {
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> right = Eigen::Matrix<double, 6, 1>::Zero();

  void add(double residual, const Eigen::Matrix<double, 6, 1> &gradient) {
    normal += gradient * gradient.transpose();
    right -= residual * gradient;
  }
};

// Matches of a query; errors are in pixels.
class PoseProblem {
 public:
  virtual ~PoseProblem() = default;
  virtual uint32_t count() const = 0;
  virtual uint32_t sampleSize() const = 0;
  // Draws `sampleSize` different matches; false when there are too few.
  virtual bool drawSample(Random *random, std::vector<uint32_t> *sample) const;
  // Poses camera_from_map that agree with a sample.
  virtual std::vector<Rigid> solve(const std::vector<uint32_t> &sample) const = 0;
  virtual double squaredError(uint32_t match, const Rigid &camera_from_map) const = 0;
  // Adds a match's error and how it changes with the pose.
  virtual void addEquations(uint32_t match, const Rigid &camera_from_map, PoseEquations *equations) const = 0;
};

struct RobustPoseOptions {
  double gate_px = 1.5;
  // Stops when an all-inlier sample was missed with a smaller probability.
  double success_probability = 0.9999;
  uint32_t min_iterations = 10, max_iterations = 10000;
  uint32_t refine_iterations = 20;  // of Levenberg-Marquardt
};

struct RobustPose {
  Rigid camera_from_map;
  uint32_t inliers = 0;  // 0: no pose was found
  uint32_t iterations = 0, hypotheses = 0;
};

// The pose with the least sum of squared errors, each cut at the gate (Torr and Zisserman, MSAC, 2000).  A new best
// sample's pose is refined by Levenberg-Marquardt on that sum.  The same seed gives the same answer.
RobustPose findPose(const PoseProblem &problem, const RobustPoseOptions &options, uint64_t seed);

}  // namespace sphc::host
