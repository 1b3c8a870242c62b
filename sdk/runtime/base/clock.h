// Time by the caller's clock: the library has none of its own.
#pragma once
#include <cstdint>

namespace sphc {

struct Clock {
  int64_t (*read)(void *user) = nullptr;  // nanoseconds, monotonic; null: no clock
  void *user = nullptr;

  int64_t now() const { return read ? read(user) : 0; }
};

// Times may lie anywhere in their range, so their difference may not.  0 where time stepped back.
inline uint64_t elapsedNs(int64_t begin_ns, int64_t end_ns) {
  return end_ns > begin_ns ? static_cast<uint64_t>(end_ns) - static_cast<uint64_t>(begin_ns) : 0;
}

inline uint64_t apartNs(int64_t a_ns, int64_t b_ns) {
  return a_ns < b_ns ? elapsedNs(a_ns, b_ns) : elapsedNs(b_ns, a_ns);
}

inline double secondsOf(uint64_t ns) { return 1e-9 * static_cast<double>(ns); }

}  // namespace sphc
