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
  bool passed() const { return clock.read && clock.now() >= time_ns; }
};

}  // namespace sphc
