// How the camera moved lately, by odometry: for images that were taken before the frame, or after it.
#pragma once
#include <cstddef>
#include <cstdint>

#include "runtime/geometry/rigid.h"

namespace sphc {

class RecentSteps {
 public:
  static constexpr size_t kMost = 32;  // 0.35 s at 90 Hz

  void clear() { count_ = 0; }
  // From the frame before to this one, `took_ns` > 0 later.  The oldest one may go.
  void push(const Rigid &now_from_before, uint64_t took_ns);
  // From `ago_ns` before the last frame to it; from `ahead_ns` after it to it.  Within a step the camera turns
  // steadily and its centre moves in a straight line; so it does kNearNs before and after all that is known.  False
  // where that says nothing, and beyond kReachNs.
  bool nowFromAgo(uint64_t ago_ns, Rigid *now_from_ago) const;
  bool nowFromAhead(uint64_t ahead_ns, Rigid *now_from_ahead) const;

 private:
  struct Step {
    Rigid now_from_before;
    uint64_t took_ns = 0;
  };
  // The newest is 0.
  const Step &at(size_t back) const { return steps_[(newest_ + kMost - back) % kMost]; }

  Step steps_[kMost];
  size_t newest_ = 0, count_ = 0;
};

}  // namespace sphc
