// A point in time at which work stops, by the caller's clock.
#pragma once
#include "runtime/base/clock.h"

namespace sphc {

struct Deadline {
  Clock clock;  // none: no deadline
  int64_t time_ns = 0;

  // Far deadlines end with the clock's range.
  static Deadline after(const Clock &clock, int64_t begin_ns, int64_t allowed_ns) {
    return {clock, begin_ns > INT64_MAX - allowed_ns ? INT64_MAX : begin_ns + allowed_ns};
  }
  bool isSet() const { return clock.read; }
  // 0 where there is none.
  uint64_t leftNs() const { return isSet() ? elapsedNs(clock.now(), time_ns) : 0; }
  bool passed() const { return isSet() && clock.now() >= time_ns; }
  // Where a share, less than 1, of the time that is left has gone; none where there is none.
  Deadline afterShare(double share) const {
    if (!isSet()) return {};
    const int64_t now = clock.now();
    const auto part = static_cast<uint64_t>(share * static_cast<double>(elapsedNs(now, time_ns)));
    return {clock, static_cast<int64_t>(static_cast<uint64_t>(now) + part)};
  }
};

// Asks for a deadline now and then: the clock is read once in so much work, and not at all without a deadline.
class Watch {
 public:
  Watch(const Deadline &deadline, uint32_t grain) : deadline_(deadline), grain_(grain), since_(grain) {}

  // Before so much work; once true, always.
  bool passed(uint32_t work) {
    if (passed_ || !deadline_.isSet()) return passed_;
    if (since_ >= grain_) {
      since_ = 0;
      passed_ = deadline_.passed();
    }
    since_ += work;
    return passed_;
  }
  // Did an earlier call say so?
  bool hasPassed() const { return passed_; }

 private:
  Deadline deadline_;
  uint32_t grain_, since_;
  bool passed_ = false;
};

}  // namespace sphc
