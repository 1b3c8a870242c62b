// Nanoseconds as seconds.
#pragma once
#include <cstdint>

namespace sphc::host {

inline double inSeconds(int64_t time_ns) { return 1e-9 * static_cast<double>(time_ns); }

}  // namespace sphc::host
