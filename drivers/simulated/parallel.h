// parallel.h - a loop shared among threads that are joined before it returns.
#pragma once

#include <cstdint>
#include <functional>

namespace sphc::simulated {

// Calls body(i) once for each i in [0, count), in no order, on up to `threads` threads (0: one a core), the
// caller's among them.  If a thread cannot be started the others do its work.  Rethrows the first exception of a
// body.
void parallelFor(uint32_t count, uint32_t threads, const std::function<void(uint32_t)> &body);

}  // namespace sphc::simulated
