// When a capture was taken.
#pragma once
#include <algorithm>

#include "spherecloud/spherecloud_capture.h"

namespace sphc {

// The middle of the exposure, as far as the capture tells.
inline int64_t middleNs(const sphc_capture &capture) {
  const int64_t half = int64_t{capture.exposure_us} * 500, time = capture.time_ns;
  if (capture.time_point == SPHC_TIME_START) return time > INT64_MAX - half ? INT64_MAX : time + half;
  if (capture.time_point == SPHC_TIME_END) return time < INT64_MIN + half ? INT64_MIN : time - half;
  return time;
}

}  // namespace sphc
