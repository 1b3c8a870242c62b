// Does a frame of a recording contradict itself, as the localizer would say of it?
#pragma once
#include <vector>

#include "host/recording/calibration.h"
#include "runtime/stages/consistency/consistency.h"

namespace sphc::host {

// Frames come in the order of their times.
class FrameConsistency {
 public:
  explicit FrameConsistency(const sphc_rig &calibration);

  // A pair of images of the calibration's sizes; the times are those of the middles of their exposures.
  Faults look(const sphc_image &color, int64_t color_time_ns, const sphc_image &depth, int64_t depth_time_ns);

 private:
  Rigid color_from_depth_;
  std::vector<uint8_t> state_, scratch_, gray_;
  Consistency consistency_;
};

}  // namespace sphc::host
