// From libcamera's timestamps to the C interface's times, all on CLOCK_MONOTONIC.
#pragma once

#include <spherecloud/spherecloud_capture.h>

namespace sphc::libcamera {

// Read together, when the frame was taken over.
struct HostClocks {
  int64_t monotonic_ns;
  int64_t boottime_ns;  // goes on while the machine sleeps; never behind
};
HostClocks readHostClocks();

struct FrameTime {
  int64_t time_ns;
  sphc_time_point point;
  uint32_t sigma_us;
};

// By libcamera's book SensorTimestamp is on CLOCK_BOOTTIME; its UVC handler passes the kernel's CLOCK_MONOTONIC on.
// The two differ once the machine has slept, so this looks which of them the frames of a stream fit.
class FrameClock {
 public:
  // 0: not known; that from a frame to the next then, but no less than at 30 Hz.
  explicit FrameClock(int64_t period_ns = 0);

  // The stream starts: its frames are no older, but may wait as long as they like for who takes them over.
  void restart(const HostClocks &now);

  // `sensor_time_ns` of the start of the exposure, or <= 0; `exposure_us` 0: not known.
  FrameTime frameTime(int64_t sensor_time_ns, int64_t exposure_us, const HostClocks &arrival);

 private:
  bool isFresh(int64_t start_ns, const HostClocks &arrival) const;

  int64_t oldest_ns_ = 0;
  int64_t period_ns_;
  bool is_guessed_;
  int64_t last_start_ns_ = 0;
  bool is_boottime_ = false;
  int64_t slept_ns_ = -1;  // boottime less monotonic; kept while it holds, so that reading clocks adds no jitter
};

}  // namespace sphc::libcamera
