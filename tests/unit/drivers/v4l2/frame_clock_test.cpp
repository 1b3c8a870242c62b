#include "drivers/v4l2/frame_clock.h"

#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include "drivers/v4l2/v4l2.h"

namespace sphc::v4l2 {
namespace {

constexpr int64_t kMs = 1000000, kStart = 1000 * kMs, kPeriod = 33 * kMs;
constexpr uint32_t kSoe = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
constexpr uint32_t kEof = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | V4L2_BUF_FLAG_TSTAMP_SRC_EOF;

FrameClock startedClock(uint32_t exposure_us = 0) {
  FrameClock clock;
  clock.restart(kStart, kPeriod);
  clock.setExposure(exposure_us);
  return clock;
}

FrameClock::Stamp stamped(FrameClock &clock, int64_t device_ns, uint32_t flags, int64_t arrival_ns) {
  FrameClock::Stamp stamp = {};
  EXPECT_TRUE(clock.stamp(device_ns, flags, arrival_ns, &stamp));
  return stamp;
}

TEST(FrameClock, SaysStartAndEndWhenTheExposureIsNotKnown) {
  FrameClock clock = startedClock();
  const FrameClock::Stamp start = stamped(clock, kStart + 10 * kMs, kSoe, kStart + 20 * kMs);
  EXPECT_EQ(start.time_ns, kStart + 10 * kMs);
  EXPECT_EQ(start.time_point, SPHC_TIME_START);
  EXPECT_EQ(start.exposure_us, 0u);
  EXPECT_NEAR(start.time_sigma_us, 33000 / 2 / 1.7321, 2) << "half of anything up to a period";
  const FrameClock::Stamp end = stamped(clock, kStart + 50 * kMs, kEof, kStart + 60 * kMs);
  EXPECT_EQ(end.time_ns, kStart + 50 * kMs);
  EXPECT_EQ(end.time_point, SPHC_TIME_END);
}

TEST(FrameClock, MovesToTheMiddleOfAKnownExposure) {
  FrameClock clock = startedClock(8000);
  const FrameClock::Stamp start = stamped(clock, kStart + 10 * kMs, kSoe, kStart + 20 * kMs);
  EXPECT_EQ(start.time_ns, kStart + 14 * kMs);
  EXPECT_EQ(start.time_point, SPHC_TIME_MIDDLE);
  EXPECT_EQ(start.exposure_us, 8000u);
  EXPECT_EQ(start.time_sigma_us, 8000u) << "the start may have been the end";
  const FrameClock::Stamp end = stamped(clock, kStart + 50 * kMs, kEof, kStart + 60 * kMs);
  EXPECT_EQ(end.time_ns, kStart + 46 * kMs);
  EXPECT_EQ(end.time_point, SPHC_TIME_MIDDLE);
  EXPECT_GT(end.time_sigma_us, 5000u) << "the readout is not known";
}

TEST(FrameClock, TakesArrivalWhenTheDeviceHasNoMonotonicTime) {
  FrameClock clock = startedClock();
  for (const uint32_t flags : {uint32_t{V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN}, uint32_t{V4L2_BUF_FLAG_TIMESTAMP_COPY}}) {
    const int64_t arrival_ns = kStart + (flags ? 60 : 20) * kMs;
    clock.sawNoFrame(arrival_ns - 20 * kMs);
    const FrameClock::Stamp stamp = stamped(clock, kStart + 10 * kMs, flags, arrival_ns);
    EXPECT_EQ(stamp.time_ns, arrival_ns);
    EXPECT_EQ(stamp.time_point, SPHC_TIME_ARRIVAL);
    EXPECT_EQ(stamp.time_sigma_us, 33000u);
    EXPECT_FALSE(stamp.is_replaced) << "nothing is wrong with the device";
  }
}

TEST(FrameClock, ArrivalIsAsUnsureAsTheFrameMayHaveWaited) {
  FrameClock clock = startedClock();
  const auto sigmaUs = [&](int64_t arrival_ns) {
    return stamped(clock, 0, V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN, arrival_ns).time_sigma_us;
  };
  EXPECT_EQ(sigmaUs(kStart + 150 * kMs), 150000u) << "since the start";
  clock.sawNoFrame(kStart + 160 * kMs);
  EXPECT_EQ(sigmaUs(kStart + 180 * kMs), 33000u);
  EXPECT_EQ(sigmaUs(kStart + 260 * kMs), 100000u);
  EXPECT_EQ(sigmaUs(kStart + 261 * kMs), 101000u) << "it may have waited as long as the one before";
  EXPECT_EQ(sigmaUs(kStart + 5000000 * kMs), UINT32_MAX) << "an hour and more";
}

TEST(FrameClock, ReplacesTimesThatCannotBe) {
  FrameClock clock = startedClock();
  const int64_t before_start = kStart - 200 * kMs, future = kStart + 500 * kMs;
  int64_t arrival_ns = kStart + 20 * kMs;
  for (const int64_t device_ns : {before_start, future, int64_t{-1}, int64_t{0}, INT64_MAX}) {
    const FrameClock::Stamp stamp = stamped(clock, device_ns, kSoe, arrival_ns);
    EXPECT_TRUE(stamp.is_replaced) << device_ns;
    EXPECT_EQ(stamp.time_ns, arrival_ns);
    EXPECT_EQ(stamp.time_point, SPHC_TIME_ARRIVAL);
    arrival_ns += kPeriod;
  }
}

TEST(FrameClock, ToleratesALittleFuture) {  // vivid's lie up to 29 ms ahead at 30 Hz
  FrameClock clock = startedClock();
  EXPECT_FALSE(stamped(clock, kStart + 49 * kMs, kEof, kStart + 20 * kMs).is_replaced);
}

TEST(FrameClock, NeverGoesBackNorStandsStill) {
  FrameClock clock = startedClock();
  stamped(clock, kStart + 30 * kMs, kSoe, kStart + 40 * kMs);
  const FrameClock::Stamp back = stamped(clock, kStart + 5 * kMs, kSoe, kStart + 70 * kMs);
  EXPECT_TRUE(back.is_replaced);
  EXPECT_EQ(back.time_ns, kStart + 70 * kMs);
  FrameClock::Stamp refused;
  EXPECT_FALSE(clock.stamp(kStart + 70 * kMs, kSoe, kStart + 70 * kMs, &refused));
  clock.restart(kStart + 80 * kMs, kPeriod);
  EXPECT_FALSE(stamped(clock, kStart + 81 * kMs, kSoe, kStart + 90 * kMs).is_replaced);
}

// A slow caller takes frames later than a period after their times, and an arrival overtakes the next of them.
TEST(FrameClock, OneTimeThatCannotBeSpoilsNoneOfThoseAfterIt) {
  FrameClock clock = startedClock();
  const int64_t late_ns = 3 * kPeriod + 20 * kMs;
  const auto time_ns = [](int frame) { return kStart + frame * kPeriod; };
  EXPECT_FALSE(stamped(clock, time_ns(1), kSoe, time_ns(1) + late_ns).is_replaced);
  EXPECT_TRUE(stamped(clock, 0, kSoe, time_ns(2) + late_ns).is_replaced);
  FrameClock::Stamp stamp;
  int frame = 3;
  for (; frame <= 5; ++frame) EXPECT_FALSE(clock.stamp(time_ns(frame), kSoe, time_ns(frame) + late_ns, &stamp));
  for (; frame <= 40; ++frame) {
    stamp = stamped(clock, time_ns(frame), kSoe, time_ns(frame) + late_ns);
    EXPECT_EQ(stamp.time_ns, time_ns(frame));
    EXPECT_EQ(stamp.time_point, SPHC_TIME_START);
  }
}

TEST(FrameClock, AClockThatStaysBehindLosesNoMoreThanARing) {
  FrameClock clock = startedClock();
  int64_t arrival_ns = kStart + 100000 * kMs;
  stamped(clock, kStart + 10 * kMs, kSoe, kStart + 20 * kMs);
  EXPECT_TRUE(stamped(clock, 0, kSoe, arrival_ns).is_replaced);
  FrameClock::Stamp stamp;
  uint32_t left_out = 0;
  for (int frame = 1; frame <= 200; ++frame) {
    arrival_ns += kPeriod;
    if (!clock.stamp(kStart + 10 * kMs + frame * kPeriod, kSoe, arrival_ns, &stamp)) {
      ++left_out;
      continue;
    }
    EXPECT_EQ(stamp.time_ns, arrival_ns);
  }
  EXPECT_EQ(left_out, SPHC_V4L2_MAX_BUFFERS);
}

TEST(FrameClock, ATimeAheadDoesNotHoldUpTheNextStart) {
  FrameClock clock = startedClock();
  EXPECT_FALSE(stamped(clock, kStart + 90 * kMs, kEof, kStart + 20 * kMs).is_replaced);
  clock.restart(kStart + 30 * kMs, kPeriod);
  EXPECT_FALSE(stamped(clock, kStart + 40 * kMs, kSoe, kStart + 50 * kMs).is_replaced);
}

TEST(FrameClock, TakesFramesThatWaitedLongForASlowCaller) {
  FrameClock clock = startedClock();
  EXPECT_FALSE(stamped(clock, kStart + 10 * kMs, kSoe, kStart + 60000 * kMs).is_replaced);
}

TEST(FrameClock, SurvivesPeriodsThatCannotBe) {
  FrameClock clock;
  for (const int64_t period_ns : {int64_t{-5}, int64_t{0}, INT64_MAX}) {
    clock.restart(kStart, period_ns);
    EXPECT_GT(stamped(clock, kStart + period_ns % 7 + 20 * kMs, kSoe, kStart + 50 * kMs).time_sigma_us, 0u);
    clock = FrameClock();
  }
}

}  // namespace
}  // namespace sphc::v4l2
