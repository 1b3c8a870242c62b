#include "host/live/pair_frame.h"

namespace sphc::host {

sphc_localizer_frame frameOf(const CapturePair &pair) {
  sphc_localizer_frame frame = {};
  frame.struct_size = sizeof frame;
  frame.sequence = pair.color.sequence;
  frame.color_time_ns = sphc_capture_middle_ns(&pair.color);
  frame.depth_time_ns = sphc_capture_middle_ns(&pair.depth);
  frame.color = pair.color.image;
  frame.depth = pair.depth.image;
  frame.amplitude = pair.depth.amplitude;
  return frame;
}

}  // namespace sphc::host
