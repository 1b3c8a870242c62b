#include "runtime/localizer/recent_ambiguity.h"

#include "runtime/base/clock.h"
#include "runtime/base/elementary.h"
#include "runtime/localizer/tracker.h"
#include "runtime/localizer/tuning.h"

namespace sphc {

using namespace tuning;

void RecentAmbiguity::advance(int64_t time_ns) {
  const uint64_t step_ns = elapsedNs(time_ns_, time_ns);
  if (step_ns == 0 || step_ns > Tracker::kForgetNs) reset();
  if (frames_ > 0) {
    const double kept = expOf(-secondsOf(step_ns) / kAmbiguousSeconds);
    ambiguous_ *= kept;
    frames_ *= kept;
  }
  time_ns_ = time_ns;
}

void RecentAmbiguity::add(bool is_ambiguous) {
  ambiguous_ += is_ambiguous ? 1 : 0;
  frames_ += 1;
}

bool RecentAmbiguity::isSeen() const {
  return ambiguous_ >= kFewestAmbiguous && ambiguous_ >= kShareAmbiguous * frames_;
}

}  // namespace sphc
