#include "frame_time.h"

#include <algorithm>
#include <cstdlib>
#include <ctime>

namespace sphc::libcamera {

namespace {

constexpr int64_t kNsPerUs = 1000, kNsPerS = 1000000000;
constexpr int64_t kBeforeStartNs = 2 * kNsPerS;  // a frame that was exposed longer before the start is none of it
constexpr int64_t kEarlyNs = 5000000;  // a time may be that far ahead: the kernel guesses it from the bus's clock
constexpr int64_t kReadingErrorNs = 1000000;  // two clocks are not read at the same moment
constexpr int64_t kLongestExposureUs = 10000000;

int64_t read(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return now.tv_sec * kNsPerS + now.tv_nsec;
}

}  // namespace

HostClocks readHostClocks() { return {read(CLOCK_MONOTONIC), read(CLOCK_BOOTTIME)}; }

FrameClock::FrameClock(int64_t period_ns)
    : period_ns_(period_ns > 0 ? period_ns : kNsPerS / 30), is_guessed_(period_ns <= 0) {}

void FrameClock::restart(const HostClocks &now) { oldest_ns_ = now.monotonic_ns - kBeforeStartNs; }

bool FrameClock::isFresh(int64_t start_ns, const HostClocks &arrival) const {
  return start_ns >= oldest_ns_ && start_ns <= arrival.monotonic_ns + kEarlyNs;
}

FrameTime FrameClock::frameTime(int64_t sensor_time_ns, int64_t exposure_us, const HostClocks &arrival) {
  const int64_t slept_ns = arrival.boottime_ns - arrival.monotonic_ns;
  if (slept_ns_ < 0 || std::llabs(slept_ns - slept_ns_) > kReadingErrorNs)
    slept_ns_ = slept_ns > kReadingErrorNs ? slept_ns : 0;
  // What is not known is taken as spread evenly: the readout and the transfer over a period, an exposure over half.
  const auto sigma_us = [this](double periods) {
    return std::max(1u, static_cast<uint32_t>(periods / 3.4641 * static_cast<double>(period_ns_ / kNsPerUs)));
  };
  const FrameTime on_arrival = {arrival.monotonic_ns, SPHC_TIME_ARRIVAL, sigma_us(2)};
  if (sensor_time_ns <= 0) return on_arrival;
  if (!isFresh(sensor_time_ns, arrival) && isFresh(sensor_time_ns - slept_ns_, arrival)) is_boottime_ = true;
  const int64_t start_ns = sensor_time_ns - (is_boottime_ ? slept_ns_ : 0);
  if (!isFresh(start_ns, arrival)) return on_arrival;
  if (is_guessed_ && last_start_ns_ > 0 && start_ns > last_start_ns_)
    period_ns_ = std::min(std::max(kNsPerS / 30, start_ns - last_start_ns_), kNsPerS);
  last_start_ns_ = start_ns;
  if (exposure_us <= 0 || exposure_us > kLongestExposureUs) return {start_ns, SPHC_TIME_START, sigma_us(1)};
  const int64_t middle_ns = start_ns + exposure_us * kNsPerUs / 2;
  if (!isFresh(middle_ns, arrival)) return {start_ns, SPHC_TIME_START, sigma_us(1)};  // it was not exposed so long
  return {middle_ns, SPHC_TIME_MIDDLE, sigma_us(0.5)};
}

}  // namespace sphc::libcamera
