#include "drivers/v4l2/frame_counter.h"

#include <gtest/gtest.h>

namespace sphc::v4l2 {
namespace {

using Kind = FrameCounter::Kind;

TEST(FrameCounter, CountsOnWhereTheDeviceDoes) {
  FrameCounter counter;
  for (uint32_t i = 0; i < 5; ++i) {
    const FrameCounter::Step step = counter.step(7 + i, i);
    EXPECT_EQ(step.kind, Kind::kNext);
    EXPECT_EQ(step.sequence, i) << "ours begins at 0";
    EXPECT_EQ(step.lost, 0u);
  }
}

TEST(FrameCounter, CountsGaps) {
  FrameCounter counter;
  counter.step(0, 0);
  const FrameCounter::Step step = counter.step(4, 1);
  EXPECT_EQ(step.lost, 3u);
  EXPECT_EQ(step.sequence, 4u);
  EXPECT_EQ(counter.step(5, 2).lost, 0u);
}

TEST(FrameCounter, GoesThroughTheWrap) {
  FrameCounter counter;
  counter.step(UINT32_MAX, 0);
  const FrameCounter::Step step = counter.step(1, 1);
  EXPECT_EQ(step.kind, Kind::kNext);
  EXPECT_EQ(step.lost, 1u);
  EXPECT_EQ(step.sequence, 2u);
}

TEST(FrameCounter, ADeviceThatTellsNeitherNumberNorTimeIsCounted) {
  FrameCounter counter;
  for (uint32_t i = 0; i < 4; ++i) {
    const FrameCounter::Step step = counter.step(0, 0);
    EXPECT_NE(step.kind, Kind::kDuplicate);
    EXPECT_EQ(step.sequence, i);
  }
}

TEST(FrameCounter, KnowsADuplicateByNumberAndTime) {
  FrameCounter counter;
  counter.step(3, 100);
  EXPECT_EQ(counter.step(3, 100).kind, Kind::kDuplicate);
  EXPECT_EQ(counter.step(3, 200).kind, Kind::kUncounted) << "a device that does not count";
  EXPECT_EQ(counter.step(4, 300).sequence, 2u);
}

TEST(FrameCounter, TakesAnotherCountForTheNextFrame) {
  FrameCounter counter;
  counter.step(500, 0);
  for (const uint32_t jump : {2u, 4000000000u, 499u}) {
    const FrameCounter::Step step = counter.step(jump, jump);
    EXPECT_EQ(step.kind, Kind::kUncounted) << jump;
    EXPECT_EQ(step.lost, 0u);
  }
  EXPECT_EQ(counter.step(500, 9).sequence, 4u);
}

TEST(FrameCounter, AGapOfMoreThanSomeMinutesIsAnotherCount) {
  FrameCounter counter;
  counter.step(0, 0);
  EXPECT_EQ(counter.step(10000, 1).lost, 9999u);
  const FrameCounter::Step step = counter.step(20001, 2);
  EXPECT_EQ(step.kind, Kind::kUncounted);
  EXPECT_EQ(step.lost, 0u);
}

TEST(FrameCounter, BeginsAgain) {
  FrameCounter counter;
  counter.step(5, 0);
  counter.step(9, 1);
  counter.restart();
  EXPECT_EQ(counter.step(0, 2).sequence, 0u);
}

}  // namespace
}  // namespace sphc::v4l2
