#include "lab/deadline/processor_clock.h"

#include <time.h>

#include <algorithm>

namespace sphc::host {
namespace {

constexpr int64_t kGapNs = 50000;  // other programs run for longer

int64_t nanoseconds(clockid_t clock) {
  timespec now;
  clock_gettime(clock, &now);
  return now.tv_sec * 1000000000ll + now.tv_nsec;
}

}  // namespace

int64_t ProcessorClock::now_ns() {
  int64_t monotonic_ns = nanoseconds(CLOCK_MONOTONIC);
  if (monotonic_ns_ == INT64_MIN || monotonic_ns - monotonic_ns_ > kGapNs) {
    const int64_t processor_ns = nanoseconds(CLOCK_THREAD_CPUTIME_ID);
    monotonic_ns = nanoseconds(CLOCK_MONOTONIC);
    ahead_ns_ = monotonic_ns - processor_ns;
  }
  monotonic_ns_ = monotonic_ns;
  now_ns_ = std::max(now_ns_, monotonic_ns - ahead_ns_);
  return now_ns_;
}

}  // namespace sphc::host
