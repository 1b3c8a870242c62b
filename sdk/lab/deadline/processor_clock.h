// Processor time of this thread, as cheap to read as a device's clock.
#pragma once
#include <cstdint>

namespace sphc::host {

// The system's own clock of a thread may take half a microsecond, and a frame with a deadline reads it some hundred
// times: a tenth of the time that it measures.  The monotonic clock takes a twentieth of that, and differs from it
// only where another program ran, which shows as a gap between two readings.
class ProcessorClock {
 public:
  // Never goes back.
  int64_t now_ns();

 private:
  int64_t monotonic_ns_ = INT64_MIN;  // at the last reading
  int64_t ahead_ns_ = 0;              // of processor time, the monotonic clock
  int64_t now_ns_ = 0;
};

}  // namespace sphc::host
