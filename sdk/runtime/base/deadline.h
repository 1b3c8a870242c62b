// A point in time at which work stops, by the caller's clock.
#pragma once
#include <cstdint>

namespace sphc {

struct Deadline {
  int64_t (*clock)(void *user) = nullptr;  // nanoseconds, monotonic; null: no deadline
  void *user = nullptr;
  int64_t time_ns = 0;

  bool passed() const { return clock && clock(user) >= time_ns; }
};

}  // namespace sphc
