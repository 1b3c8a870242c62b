// A clock that goes on whenever it is read, so that time is the number of times it is read.
#pragma once
#include "runtime/base/deadline.h"

namespace sphc::test {

struct SteppingClock {
  explicit SteppingClock(int64_t step) : step_ns(step) {}
  SteppingClock(const SteppingClock &) = delete;
  SteppingClock &operator=(const SteppingClock &) = delete;

  int64_t step_ns, now_ns = 0;
  uint64_t reads = 0;
  // At this read it goes on by so much more, as where the thread had to wait.
  uint64_t late_read = 0;
  int64_t late_by_ns = 0;

  static int64_t read(void *user) {
    auto *self = static_cast<SteppingClock *>(user);
    if (++self->reads == self->late_read) self->now_ns += self->late_by_ns;
    return self->now_ns += self->step_ns;
  }
  Clock clock() { return {&read, this}; }
  Deadline deadline(int64_t at_ns) { return {clock(), at_ns}; }
};

}  // namespace sphc::test
