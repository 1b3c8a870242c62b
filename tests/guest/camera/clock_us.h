// The camera's own clock, 1 MHz; wraps.
#pragma once

#include <chrono>
#include <cstdint>

namespace sphc::guest {

inline uint32_t clockUs() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return static_cast<uint32_t>(std::chrono::duration_cast<std::chrono::microseconds>(now).count());
}

}  // namespace sphc::guest
