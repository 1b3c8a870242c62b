#include "runtime/localizer/recent_steps.h"

#include <algorithm>

#include "runtime/base/clock.h"
#include "runtime/base/elementary.h"
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

// Errors of steps are independent, and so they are of parts of a step; of what goes on so they are the same.
double varianceOf(double sigma, double share) { return sigma * sigma * std::max(absOf(share), share * share); }

}  // namespace

void RecentSteps::push(const Way &step, uint64_t took_ns) {
  if (secondsOf(took_ns) > kSteadySeconds) return clear();  // nothing is known of what is between
  newest_ = (newest_ + 1) % kMost;
  steps_[newest_] = {step, took_ns};
  count_ = std::min(count_ + 1, kMost);
}

bool RecentSteps::wayFromAgo(uint64_t ago_ns, Way *way) const {
  if (count_ == 0 || ago_ns > kReachNs) return false;
  Rigid now_from_end;  // of the step that is looked at
  double turn_variance = 0, shift_variance = 0;
  uint64_t end_ago_ns = 0;
  size_t back = 0;
  for (; back + 1 < count_ && ago_ns > end_ago_ns + at(back).took_ns; ++back) {
    const Way &step = at(back).way;
    now_from_end = now_from_end * step.now_from_then;
    turn_variance += varianceOf(step.turn_sigma_rad, 1);
    shift_variance += varianceOf(step.shift_sigma_m, 1);
    end_ago_ns += at(back).took_ns;
  }
  const Step &last = at(back);
  const bool is_beyond = ago_ns > end_ago_ns + last.took_ns;
  if (is_beyond && ago_ns > kNearNs) return false;
  const double share = secondsOf(ago_ns - end_ago_ns) / secondsOf(last.took_ns);
  *way = {now_from_end * endFrom(last.way.now_from_then, share),
          sqrtOf(turn_variance + varianceOf(last.way.turn_sigma_rad, share)),
          sqrtOf(shift_variance + varianceOf(last.way.shift_sigma_m, share))};
  return true;
}

bool RecentSteps::wayFromAhead(uint64_t ahead_ns, Way *way) const {
  if (count_ == 0 || ahead_ns > kNearNs) return false;
  const Step &newest = at(0);
  const double share = -(secondsOf(ahead_ns) / secondsOf(newest.took_ns));
  *way = {endFrom(newest.way.now_from_then, share), sqrtOf(varianceOf(newest.way.turn_sigma_rad, share)),
          sqrtOf(varianceOf(newest.way.shift_sigma_m, share))};
  return true;
}

}  // namespace sphc
