#include "runtime/localizer/recent_ambiguity.h"

#include "runtime/base/clock.h"

namespace sphc {

void RecentAmbiguity::advance(int64_t time_ns) {
  const double aged = 1 + secondsOf(elapsedNs(time_ns_, time_ns));
  const double kept = time_ns > time_ns_ ? 1 / (aged * aged) : 0;  // e^(-2 s) of frames near in time
  ambiguous_ *= kept;
  frames_ *= kept;
  time_ns_ = time_ns;
}

}  // namespace sphc
