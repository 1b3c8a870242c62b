// A point in time at which work stops, by the caller's clock.
#pragma once
#include <cstdint>

namespace sphc {

struct Deadline {
  int64_t (*clock)(void *user) = nullptr;  // nanoseconds, monotonic; null: no deadline
  void *user = nullptr;
  int64_t time_ns = 0;

  // Far deadlines end with the clock's range.
  static Deadline after(int64_t (*clock)(void *user), void *user, int64_t begin_ns, int64_t allowed_ns) {
    return {clock, user, begin_ns > INT64_MAX - allowed_ns ? INT64_MAX : begin_ns + allowed_ns};
  }
  bool passed() const { return clock && clock(user) >= time_ns; }
};

}  // namespace sphc
