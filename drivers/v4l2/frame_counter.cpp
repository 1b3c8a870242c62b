#include "frame_counter.h"

namespace sphc::v4l2 {

namespace {

constexpr uint32_t kMaxGap = 10000;  // some minutes; a greater one is another count

}  // namespace

FrameCounter::Step FrameCounter::step(uint32_t device_sequence, int64_t device_time_ns) {
  const uint32_t advance = device_sequence - last_device_sequence_;  // right through the wrap
  if (has_last_ && advance == 0 && device_time_ns > 0 && device_time_ns == last_time_ns_)
    return {Kind::kDuplicate, sequence_, 0};
  const bool is_counted = !has_last_ || (advance >= 1 && advance <= kMaxGap);
  if (has_last_) sequence_ += is_counted ? advance : 1;
  const uint32_t lost = has_last_ && is_counted ? advance - 1 : 0;
  has_last_ = true;
  last_device_sequence_ = device_sequence;
  last_time_ns_ = device_time_ns;
  return {is_counted ? Kind::kNext : Kind::kUncounted, sequence_, lost};
}

}  // namespace sphc::v4l2
