#include "runtime/localizer/recent_steps.h"

#include <algorithm>

#include "runtime/base/clock.h"
#include "runtime/geometry/rotation.h"
#include "runtime/localizer/tuning.h"

namespace sphc {
namespace {

using namespace tuning;

// To the end of a step from a share of it before that; from beyond its ends at shares above 1 and below 0.
Rigid endFrom(const Rigid &step, double share) {
  const double then = 1 - share;
  const Matrix3 turned = rotationFromVector(then * vectorFromRotation(step.rotation));
  const Vector3 center = then * step.inverse().translation_m;  // in the camera's frame where the step begins
  return step * Rigid{turned, -(turned * center)}.inverse();
}

}  // namespace

void RecentSteps::push(const Rigid &now_from_before, uint64_t took_ns) {
  if (secondsOf(took_ns) > kSteadySeconds) return clear();  // nothing is known of what is between
  newest_ = (newest_ + 1) % kMost;
  steps_[newest_] = {now_from_before, took_ns};
  count_ = std::min(count_ + 1, kMost);
}

bool RecentSteps::nowFromAgo(uint64_t ago_ns, Rigid *now_from_ago) const {
  if (count_ == 0 || ago_ns > kReachNs) return false;
  Rigid now_from_end;  // of the step that is looked at
  uint64_t end_ago_ns = 0;
  size_t back = 0;
  for (; back + 1 < count_ && ago_ns > end_ago_ns + at(back).took_ns; ++back) {
    now_from_end = now_from_end * at(back).now_from_before;
    end_ago_ns += at(back).took_ns;
  }
  const Step &step = at(back);
  const bool is_beyond = ago_ns > end_ago_ns + step.took_ns;
  if (is_beyond && ago_ns > kNearNs) return false;
  *now_from_ago =
      now_from_end * endFrom(step.now_from_before, secondsOf(ago_ns - end_ago_ns) / secondsOf(step.took_ns));
  return true;
}

bool RecentSteps::nowFromAhead(uint64_t ahead_ns, Rigid *now_from_ahead) const {
  if (count_ == 0 || ahead_ns > kNearNs) return false;
  const Step &newest = at(0);
  *now_from_ahead = endFrom(newest.now_from_before, -(secondsOf(ahead_ns) / secondsOf(newest.took_ns)));
  return true;
}

}  // namespace sphc
