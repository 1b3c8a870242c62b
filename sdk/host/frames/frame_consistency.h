// Does a frame of a recording contradict itself, as the localizer would say of it?
#pragma once
#include <array>
#include <vector>

#include "host/recording/calibration.h"
#include "runtime/stages/consistency/consistency.h"

namespace sphc::host {

// How many frames had each fault.
class FaultCounts {
 public:
  void add(Faults faults) {
    for (size_t bit = 0; bit < counts_.size(); ++bit) counts_[bit] += (faults >> bit) & 1u;
  }
  // `fault` is one bit.
  uint32_t of(Faults fault) const {
    size_t bit = 0;
    while (fault >> bit > 1) ++bit;
    return counts_[bit];
  }

 private:
  std::array<uint32_t, 32> counts_ = {};
};

// Frames come in the order of their times.
class FrameConsistency {
 public:
  // Depth is used between these.
  FrameConsistency(const sphc_rig &calibration, double depth_min_m, double depth_max_m);

  // A pair of images of the calibration's sizes; the times are those of the middles of their exposures.
  // camera_from_camera_at_depth: from the colour camera where it was when depth was taken, to where it was when
  // colour was.
  Faults look(const sphc_image &color, int64_t color_time_ns, const sphc_image &depth, int64_t depth_time_ns,
              const Rigid &camera_from_camera_at_depth = {});

 private:
  Rigid color_from_depth_;
  std::vector<uint8_t> state_, scratch_, gray_;
  Consistency consistency_;
};

}  // namespace sphc::host
