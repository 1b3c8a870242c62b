#include "drivers/openni2/timeline.h"

#include <gtest/gtest.h>

#include "runtime/base/random.h"

namespace sphc::openni2 {

namespace {

constexpr int64_t kFramePeriodNs = 33333000;
constexpr int64_t kPeriods[kStreams] = {kFramePeriodNs, kFramePeriodNs};
constexpr int64_t kMs = 1000000, kS = 1000 * kMs;

Timeline live() {
  Timeline timeline;
  timeline.start(false, kPeriods);
  return timeline;
}
Timeline recorded() {
  Timeline timeline;
  timeline.start(true, kPeriods);
  return timeline;
}

TEST(Timeline, GivesTimesAndIndicesOnWhenAllIsWell) {
  Timeline timeline = live();
  for (int i = 5; i < 10; ++i)
    for (const int stream : {kColor, kDepth}) {
      const Place place =
          timeline.place(stream, i, static_cast<uint64_t>(i) * 33333, 100 * kS + i * kFramePeriodNs);
      EXPECT_EQ(place.sequence, static_cast<uint32_t>(i));
      EXPECT_EQ(place.time_ns, i * kFramePeriodNs);
      EXPECT_EQ(place.lost, 0u);
      EXPECT_FALSE(place.duplicate || place.clock_jumped);
    }
}

TEST(Timeline, CountsWhatIsMissing) {
  Timeline timeline = live();
  timeline.place(kDepth, 1, 100, 0);
  const Place place = timeline.place(kDepth, 11, 333430, 333 * kMs);
  EXPECT_EQ(place.lost, 9u);
  EXPECT_EQ(place.sequence, 11u);
  EXPECT_EQ(timeline.place(kColor, 3, 100, 0).lost, 0u) << "the other stream has its own count";
}

TEST(Timeline, CountsOnWhenTheCounterBeginsAnew) {
  Timeline timeline = live();
  timeline.place(kDepth, 1000, 100, 0);
  Place place = timeline.place(kDepth, 1, 200, kMs);
  EXPECT_EQ(place.sequence, 1001u);
  EXPECT_EQ(place.lost, 0u);
  place = timeline.place(kDepth, INT32_MAX, 300, 2 * kMs);  // no gap is so wide
  EXPECT_EQ(place.sequence, 1002u);
  EXPECT_EQ(place.lost, 0u);
  place = timeline.place(kDepth, INT32_MIN, 400, 3 * kMs);
  EXPECT_EQ(place.sequence, 1003u);
}

TEST(Timeline, KnowsAFrameThatComesTwice) {
  Timeline timeline = live();
  timeline.place(kDepth, 7, 100, 0);
  EXPECT_TRUE(timeline.place(kDepth, 7, 100, kMs).duplicate);
  EXPECT_TRUE(timeline.place(kDepth, 7, 200, kMs).duplicate);
  EXPECT_FALSE(timeline.place(kDepth, 8, 200, kMs).duplicate);
}

TEST(Timeline, BridgesAClockThatJumpsAndKeepsTheStreamsTogether) {
  for (const int64_t jump_us : {-20000000, -1000, 5000000, 90000000}) {
    Timeline timeline = live();
    int64_t device_us = 30000000, arrival_ns = kS;
    int64_t before_ns = 0;
    for (int i = 1; i < 6; ++i, device_us += 33333, arrival_ns += kFramePeriodNs)
      for (const int stream : {kColor, kDepth})
        before_ns = timeline.place(stream, i, static_cast<uint64_t>(device_us + 2000 * stream), arrival_ns).time_ns;
    device_us += jump_us - (jump_us == -1000 ? 40000 : 0);
    const Place color = timeline.place(kColor, 6, static_cast<uint64_t>(device_us), arrival_ns);
    const Place depth = timeline.place(kDepth, 6, static_cast<uint64_t>(device_us + 2000), arrival_ns);
    EXPECT_TRUE(color.clock_jumped && depth.clock_jumped) << jump_us;
    EXPECT_GT(color.time_ns, before_ns - 2 * kMs);
    EXPECT_LT(color.time_ns, before_ns + 2 * kFramePeriodNs);
    EXPECT_EQ(depth.time_ns - color.time_ns, 2 * kMs) << "one clock, one jump";
    const Place next =
        timeline.place(kColor, 7, static_cast<uint64_t>(device_us + 33333), arrival_ns + kFramePeriodNs);
    EXPECT_FALSE(next.clock_jumped);
    EXPECT_EQ(next.time_ns - color.time_ns, kFramePeriodNs);
  }
}

TEST(Timeline, ALongPauseIsNoJump) {
  Timeline timeline = live();
  timeline.place(kDepth, 1, 1000, kS);
  const Place place = timeline.place(kDepth, 2, 60001000, 61 * kS);
  EXPECT_FALSE(place.clock_jumped);
  EXPECT_EQ(place.time_ns, 60001 * kMs);
}

TEST(Timeline, ALateDeliveryIsNoJump) {
  Timeline timeline = live();
  timeline.place(kDepth, 1, 1000, kS);
  EXPECT_FALSE(timeline.place(kDepth, 2, 34333, 10 * kS).clock_jumped);
}

TEST(Timeline, PutsTheLaterStreamOfARecordingWhereItBegan) {
  Timeline timeline = recorded();
  for (int i = 1; i <= 5; ++i) timeline.place(kDepth, i, static_cast<uint64_t>(i - 1) * 33333, 0);
  EXPECT_EQ(timeline.place(kColor, 1, 0, 0).time_ns, 4 * kFramePeriodNs);
  EXPECT_EQ(timeline.place(kColor, 2, 33333, 0).time_ns, 5 * kFramePeriodNs);
  EXPECT_EQ(timeline.place(kDepth, 6, 5 * 33333, 0).time_ns, 5 * kFramePeriodNs);
}

TEST(Timeline, GrowsWhateverTheDeviceSays) {
  Random random(1);
  for (const bool is_recording : {false, true}) {
    Timeline timeline;
    timeline.start(is_recording, kPeriods);
    int64_t last_ns[kStreams] = {INT64_MIN, INT64_MIN}, arrival_ns = 0;
    uint32_t last_sequence[kStreams] = {};
    bool begun[kStreams] = {};
    for (int i = 0; i < 100000; ++i) {
      const int stream = static_cast<int>(random.below(2));
      const uint64_t anything = random.next() >> random.below(64);
      const int index = static_cast<int>(static_cast<uint32_t>(random.next()) >> random.below(32));
      arrival_ns += random.below(kFramePeriodNs);
      const Place place = timeline.place(stream, index, anything, arrival_ns);
      if (place.duplicate) continue;
      ASSERT_GT(place.time_ns, last_ns[stream]) << i;
      if (begun[stream]) {
        ASSERT_EQ(place.sequence - last_sequence[stream], place.lost + 1);
      }
      begun[stream] = true;
      last_ns[stream] = place.time_ns;
      last_sequence[stream] = place.sequence;
    }
  }
}

}  // namespace

}  // namespace sphc::openni2
