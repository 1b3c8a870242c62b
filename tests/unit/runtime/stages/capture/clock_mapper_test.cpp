#include "runtime/stages/capture/clock_mapper.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "runtime/base/random.h"

namespace sphc {
namespace {

constexpr int64_t kMs = 1000000, kSecond = 1000 * kMs;

sphc_clock_mapper_config defaults() {
  sphc_clock_mapper_config config;
  EXPECT_EQ(sphc_clock_mapper_config_init(&config, sizeof config), SPHC_OK);
  return config;
}

// A device whose clock began at another time and runs at another rate; arrivals are late by at least 4 ms.
class Device {
 public:
  Device(double drift_ppm, uint64_t seed) : drift_(1e-6 * drift_ppm), random_(seed) {}

  int64_t hostNs(int64_t source_ns) const {
    return source_ns + offset_ns + static_cast<int64_t>(drift_ * static_cast<double>(source_ns - kBegin));
  }
  sphc_status feed(ClockMapper *mapper, int64_t source_ns) {
    const double late_ms = 4 - 3 * std::log(1 - 0.999 * random_.uniform());  // a long tail
    return mapper->add(source_ns, hostNs(source_ns) + static_cast<int64_t>(late_ms * 1e6));
  }

  static constexpr int64_t kBegin = 77 * kSecond;
  int64_t offset_ns = 123456 * kSecond;

 private:
  double drift_;
  Random random_;
};

int64_t mapped(const ClockMapper &mapper, int64_t source_ns) {
  int64_t host_ns = 0;
  EXPECT_EQ(mapper.map(source_ns, &host_ns), SPHC_OK);
  return host_ns;
}

TEST(ClockMapper, FindsOffsetAndDriftBelowLateArrivals) {
  for (const double drift_ppm : {-150.0, 0.0, 40.0}) {
    sphc_clock_mapper_config config = defaults();
    config.delay_ns = 4 * kMs;
    ClockMapper mapper(config);
    Device device(drift_ppm, 3);
    int64_t source_ns = Device::kBegin;
    for (int i = 0; i < 6000; ++i, source_ns += 33 * kMs) {
      ASSERT_EQ(device.feed(&mapper, source_ns), SPHC_OK);
      if (i > 200) {
        ASSERT_LT(std::llabs(mapped(mapper, source_ns) - device.hostNs(source_ns)), kMs) << i;
      }
    }
    sphc_clock_mapping mapping = {};
    ASSERT_EQ(mapper.get(&mapping), SPHC_OK);
    EXPECT_NEAR(mapping.drift_ppm, drift_ppm, 15);
    EXPECT_EQ(mapping.samples, 6000u);
    EXPECT_EQ(mapping.restarts, 0u);
    EXPECT_LT(mapping.sigma_ns, 2 * kMs);
    EXPECT_GE(mapping.sigma_ns, config.delay_sigma_ns);
  }
}

TEST(ClockMapper, OneSampleIsAnOffset) {
  ClockMapper mapper(defaults());
  int64_t host_ns = 5;
  sphc_clock_mapping mapping = {};
  EXPECT_EQ(mapper.map(0, &host_ns), SPHC_AGAIN);
  EXPECT_EQ(mapper.get(&mapping), SPHC_AGAIN);
  EXPECT_EQ(host_ns, 5);
  EXPECT_EQ(mapper.add(1000, 51000), SPHC_OK);
  EXPECT_EQ(mapped(mapper, 3000), 53000);
  ASSERT_EQ(mapper.get(&mapping), SPHC_OK);
  EXPECT_EQ(mapping.offset_ns, 50000);
  EXPECT_EQ(mapping.drift_ppm, 0);
}

TEST(ClockMapper, AClockThatIsSetStartsAnew) {
  ClockMapper mapper(defaults());
  Device device(0, 4);
  int64_t source_ns = Device::kBegin, restarts = 0;
  const auto run = [&](int samples) {
    for (int i = 0; i < samples; ++i, source_ns += 33 * kMs)
      restarts += device.feed(&mapper, source_ns) == SPHC_AGAIN;
  };
  run(300);
  device.offset_ns -= kSecond;  // arrivals too early: at once
  run(1);
  EXPECT_EQ(restarts, 1);
  run(300);
  device.offset_ns += kSecond;  // late may be a stall: only once it goes on
  run(5);
  EXPECT_EQ(restarts, 1);
  run(10);
  EXPECT_EQ(restarts, 2);
  source_ns -= 10 * kSecond;  // backwards
  run(1);
  EXPECT_EQ(restarts, 3);
  run(100);
  EXPECT_LT(std::llabs(mapped(mapper, source_ns) - device.hostNs(source_ns)), 8 * kMs);
  sphc_clock_mapping mapping = {};
  ASSERT_EQ(mapper.get(&mapping), SPHC_OK);
  EXPECT_EQ(mapping.restarts, 3u);
}

TEST(ClockMapper, ATimeThatStandsStillOrIsAnHourOnStartsAnew) {
  for (const int64_t step_ns : {int64_t{0}, 3601 * kSecond}) {
    ClockMapper mapper(defaults());
    EXPECT_EQ(mapper.add(kSecond, kSecond + kMs), SPHC_OK);
    EXPECT_EQ(mapper.add(kSecond + step_ns, kSecond + step_ns + kMs), SPHC_AGAIN) << step_ns;
  }
}

// Lateness that falls by 4 ms tells no rate within two seconds, and after three none that a clock may not have.
TEST(ClockMapper, ADriftIsNoMoreThanAClockHas) {
  const auto mappingAfter = [](int64_t time_ns, int64_t *host_ns) {
    ClockMapper mapper(defaults());
    EXPECT_EQ(mapper.add(0, 5 * kMs), SPHC_OK);
    EXPECT_EQ(mapper.add(time_ns, time_ns + kMs), SPHC_OK);
    sphc_clock_mapping mapping = {};
    EXPECT_EQ(mapper.get(&mapping), SPHC_OK);
    *host_ns = mapped(mapper, time_ns);
    return mapping;
  };
  int64_t host_ns = 0;
  EXPECT_EQ(mappingAfter(kSecond, &host_ns).drift_ppm, 0);
  const sphc_clock_mapping mapping = mappingAfter(3 * kSecond, &host_ns);
  EXPECT_NEAR(mapping.drift_ppm, -200, 1e-6);
  EXPECT_NEAR(static_cast<double>(host_ns), 3e9 + 1e6, 2) << "no sample arrives before it is taken";
  // The first is 3.4 ms late by this line, and the config's delay is known to 1 ms.
  EXPECT_NEAR(static_cast<double>(mapping.sigma_ns), std::hypot(3.4e6 / std::sqrt(2.0), 1e6), 10);
}

TEST(ClockMapper, AStallIsNoJump) {
  ClockMapper mapper(defaults());
  for (int i = 1; i <= 100; ++i) EXPECT_EQ(mapper.add(i * 10 * kMs, i * 10 * kMs + kMs), SPHC_OK);
  for (int i = 101; i <= 105; ++i) EXPECT_EQ(mapper.add(i * 10 * kMs, 3 * kSecond + i), SPHC_OK);
  EXPECT_EQ(mapped(mapper, 2 * kSecond), 2 * kSecond + kMs);
  sphc_clock_mapping mapping = {};
  ASSERT_EQ(mapper.get(&mapping), SPHC_OK);
  EXPECT_EQ(mapping.sigma_ns, defaults().delay_sigma_ns) << "what stalled tells nothing of the others";
}

TEST(ClockMapper, ForgetsWhatLiesBeyondTheWindow) {
  ClockMapper mapper(defaults());
  for (int64_t i = 1; i <= 10; ++i) ASSERT_EQ(mapper.add(i * kSecond, i * kSecond + kMs), SPHC_OK);
  for (int64_t i = 60; i <= 65; ++i) ASSERT_EQ(mapper.add(i * kSecond, i * kSecond + 9 * kMs), SPHC_OK);
  for (const int64_t time_s : {60, 65, 70})
    EXPECT_EQ(mapped(mapper, time_s * kSecond), time_s * kSecond + 9 * kMs) << time_s;
}

TEST(ClockMapper, RunsForDays) {
  ClockMapper mapper(defaults());
  for (int64_t i = 1; i <= 100000; ++i)
    ASSERT_EQ(mapper.add(i * kSecond, i * (kSecond + 100000) + 7 * kMs), SPHC_OK);
  EXPECT_LT(std::llabs(mapped(mapper, 100000 * kSecond) - 100000 * (kSecond + 100000) - 7 * kMs), 1000);
}

TEST(ClockMapper, TimesMayLieAnywhere) {
  constexpr int64_t kLeast = std::numeric_limits<int64_t>::min(), kMost = std::numeric_limits<int64_t>::max();
  for (const int64_t delay_ns : {int64_t{0}, 3600 * kSecond, -3600 * kSecond}) {
    sphc_clock_mapper_config config = defaults();
    config.delay_ns = delay_ns;
    ClockMapper mapper(config);
    for (const int64_t a : {kLeast, kLeast + 1, int64_t{-1}, int64_t{0}, kMost - kSecond, kMost})
      for (const int64_t b : {kMost, kLeast, int64_t{0}, kMost - 5}) {
        mapper.add(a, b);
        int64_t host_ns = 0;
        sphc_clock_mapping mapping;
        mapper.map(a, &host_ns);
        mapper.map(b, &host_ns);
        mapper.get(&mapping);
      }
  }
  ClockMapper mapper(defaults());
  mapper.add(0, 0);
  int64_t host_ns = 5;
  EXPECT_EQ(mapper.map(3601 * kSecond, &host_ns), SPHC_E_ARGUMENT);
  EXPECT_EQ(host_ns, 5);
}

}  // namespace
}  // namespace sphc
