// Gaps in the device's count of its frames.
#pragma once

#include <cstdint>

namespace sphc::v4l2 {

// The device's count is an outsider's word: it may stand still, jump or begin again.
class FrameCounter {
 public:
  void restart() { *this = {}; }

  enum class Kind { kNext, kDuplicate, kUncounted };
  struct Step {
    Kind kind;
    uint32_t sequence;  // ours: from 0, lost frames counted
    uint32_t lost;      // between the last frame and this one
  };
  Step step(uint32_t device_sequence, int64_t device_time_ns);

 private:
  bool has_last_ = false;
  uint32_t last_device_sequence_ = 0;
  int64_t last_time_ns_ = 0;
  uint32_t sequence_ = 0;
};

}  // namespace sphc::v4l2
