// How the camera moved lately, by odometry: for images that were taken before the frame, or after it.
#pragma once
#include <cstddef>
#include <cstdint>

#include "runtime/geometry/rigid.h"

namespace sphc {

// Of the camera from another time to the frame's; 1 sigma an axis.
struct Way {
  Rigid now_from_then;
  double turn_sigma_rad = 0, shift_sigma_m = 0;
};

class RecentSteps {
 public:
  static constexpr size_t kMost = 32;  // 0.35 s at 90 Hz

  void clear() { count_ = 0; }
  // `now_from_then` is from the frame before to this one, `took_ns` > 0 later.  The oldest one may go.
  void push(const Way &step, uint64_t took_ns);
  // From `ago_ns` before the last frame to it; from `ahead_ns` after it to it.  Within a step the camera turns
  // steadily and its centre moves in a straight line; it goes on so before and after all that is known, within
  // kNearNs of the last frame.  False where that says nothing, and beyond kReachNs.
  bool wayFromAgo(uint64_t ago_ns, Way *way) const;
  bool wayFromAhead(uint64_t ahead_ns, Way *way) const;

 private:
  struct Step {
    Way way;
    uint64_t took_ns = 0;
  };
  // The newest is 0.
  const Step &at(size_t back) const { return steps_[(newest_ + kMost - back) % kMost]; }

  Step steps_[kMost];
  size_t newest_ = 0, count_ = 0;
};

}  // namespace sphc
