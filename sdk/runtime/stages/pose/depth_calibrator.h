// Learns how the depth sensor is off, frame by frame: an information filter over the bias that each pose's
// refinement found beside the pose, and a slow average of the noise.
#pragma once
#include "runtime/types/depth_calibration.h"
#include "runtime/types/estimate.h"

namespace sphc {

class DepthCalibrator {
 public:
  // What is believed before the first frame.
  void init(const DepthCalibration &prior);
  // Goes on from what was learnt before.
  void resume(const DepthCalibration &known) { current_ = known; }
  const DepthCalibration &current() const { return current_; }
  // Takes in what a frame's trusted pose was found with; its query had current() for depth.  Nothing is learnt of a
  // sensor that is known.
  void learn(const Estimate &estimate);

 private:
  DepthCalibration prior_, current_;
};

}  // namespace sphc
