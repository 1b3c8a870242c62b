// Do frames contradict themselves, as the localizer would say of them?
#pragma once
#include "host/frames/frame_consistency.h"
#include "host/live/finding.h"

namespace sphc::host {

class ConsistencyCheck {
 public:
  // Depths that are used: those of such a range.
  ConsistencyCheck(const sphc_rig &calibration, double depth_min_m, double depth_max_m);

  // A pair of images of the calibration's sizes; the times are those of the middles of their exposures.
  void look(const sphc_image &color, int64_t color_time_ns, const sphc_image &depth, int64_t depth_time_ns);
  // One for each fault that was seen, or one that none was.
  Findings findings() const;

 private:
  FrameConsistency consistency_;
  FaultCounts seen_;
  uint32_t pairs_ = 0;
};

}  // namespace sphc::host
