#include "frame_clock.h"

#include <linux/videodev2.h>

#include <algorithm>

#include "v4l2.h"

namespace sphc::v4l2 {

namespace {

constexpr int64_t kUnknownPeriodNs = 66666667;  // slower than most
constexpr int64_t kMillisecondNs = 1000000;
constexpr int64_t kMaxPeriodNs = 60000 * kMillisecondNs;
// uvcvideo stamps the first packet of a frame, so before stream-on is not possible; vivid's ends of frames lie up
// to nine tenths of a period ahead, 29 ms at 30 Hz.
constexpr int64_t kBeforeStartNs = 100 * kMillisecondNs, kFutureNs = 100 * kMillisecondNs;
constexpr uint32_t kLeastSigmaUs = 1000;                    // of any time that the host takes
constexpr uint32_t kMostOvertaken = SPHC_V4L2_MAX_BUFFERS;  // in a row: no more can have waited

}  // namespace

void FrameClock::restart(int64_t now_ns, int64_t period_ns) {
  start_ns_ = no_frame_ns_ = now_ns;
  period_ns_ = period_ns > 0 ? std::min(period_ns, kMaxPeriodNs) : kUnknownPeriodNs;
  if (last_ns_ > now_ns) last_ns_ = now_ns;
  last_own_ns_ = last_ns_;
}

FrameClock::Stamp FrameClock::ofDevice(int64_t device_time_ns, bool is_end) const {
  // Half an exposure, or half a readout, of anything up to a period: the root of the mean square.
  const uint32_t half_of_unknown_us = static_cast<uint32_t>(static_cast<double>(period_ns_) / 3464.1);
  if (exposure_us_ == 0)
    return {device_time_ns, is_end ? SPHC_TIME_END : SPHC_TIME_START, 0, half_of_unknown_us, false};
  // uvcvideo says "start" of the first packet's arrival, which for many cameras is the end: an exposure apart.
  const uint32_t start_sigma_us = std::max(exposure_us_, kLeastSigmaUs);
  const int64_t half_ns = int64_t{exposure_us_} * 500;
  return {device_time_ns + (is_end ? -half_ns : half_ns), SPHC_TIME_MIDDLE, exposure_us_,
          is_end ? half_of_unknown_us : start_sigma_us, false};
}

// The frame may have waited for a busy caller ever since none was there.
FrameClock::Stamp FrameClock::ofArrival(int64_t arrival_ns) const {
  const int64_t sigma_us = std::max(period_ns_, arrival_ns - no_frame_ns_) / 1000;
  return {arrival_ns, SPHC_TIME_ARRIVAL, exposure_us_,
          static_cast<uint32_t>(std::min<int64_t>(sigma_us, UINT32_MAX)), false};
}

bool FrameClock::isPossible(int64_t time_ns, int64_t arrival_ns) const {
  return time_ns > last_own_ns_ && time_ns >= start_ns_ - kBeforeStartNs && time_ns <= arrival_ns + kFutureNs;
}

bool FrameClock::stamp(int64_t device_time_ns, uint32_t buffer_flags, int64_t arrival_ns, Stamp *stamp) {
  const bool is_monotonic = (buffer_flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) == V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
  const bool is_end = (buffer_flags & V4L2_BUF_FLAG_TSTAMP_SRC_MASK) == V4L2_BUF_FLAG_TSTAMP_SRC_EOF;
  *stamp = is_monotonic ? ofDevice(device_time_ns, is_end) : ofArrival(arrival_ns);
  const bool is_possible = isPossible(stamp->time_ns, arrival_ns);
  const bool is_overtaken = is_possible && stamp->time_ns <= last_ns_;
  // Its own arrival would overtake the next frame in turn, and so for ever.
  if (is_overtaken && overtaken_ < kMostOvertaken) return ++overtaken_, false;
  if (!is_possible || is_overtaken) {
    *stamp = ofArrival(arrival_ns);
    stamp->is_replaced = true;
  }
  if (stamp->time_ns <= last_ns_) return false;
  last_ns_ = stamp->time_ns;
  if (stamp->is_replaced) return true;
  last_own_ns_ = last_ns_;
  overtaken_ = 0;
  return true;
}

}  // namespace sphc::v4l2
