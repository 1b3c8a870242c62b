#include "host/guide/walk_guide.h"

#include <gtest/gtest.h>

#include "made_up_wall.h"

namespace sphc::host {
namespace {

constexpr int64_t kPeriodNs = 100000000;

// Walks along walls at ten frames a second.
class WalkGuideTest : public testing::Test {
 protected:
  GuideStep look(MadeUpWall *wall, int x_px, double light = 1, bool has_depth = true) {
    time_ns_ += kPeriodNs;
    steps_.push_back(guide_.look(wall->view(x_px, time_ns_, light, has_depth)));
    return steps_.back();
  }
  // From one place of the wall to another; the last step.
  GuideStep walk(MadeUpWall *wall, int from_px, int to_px, int step_px) {
    const int count = std::abs(to_px - from_px) / step_px, sign = to_px > from_px ? 1 : -1;
    for (int i = 0; i <= count; ++i) look(wall, from_px + i * sign * step_px);
    return steps_.back();
  }
  GuideAdvice allAdvice() const {
    GuideAdvice all = 0;
    for (const GuideStep &step : steps_) all |= step.advice;
    return all;
  }
  std::vector<ClosedLoop> loops() const {
    std::vector<ClosedLoop> all;
    for (const GuideStep &step : steps_)
      if (step.loop && step.loop->is_new) all.push_back(*step.loop);
    return all;
  }

  MadeUpWall wall_{1};
  WalkGuide guide_{wallRig()};
  std::vector<GuideStep> steps_;
  int64_t time_ns_ = 0;
};

TEST_F(WalkGuideTest, OfASlowWalkNothingIsSaid) {
  const GuideStep last = walk(&wall_, 0, 480, 20);
  EXPECT_EQ(allAdvice(), 0u);
  EXPECT_EQ(last.parts, 1u);
  EXPECT_GE(last.places, 8u);
  EXPECT_EQ(last.loops, 0u);
  const WalkSummary summary = guide_.summary();
  EXPECT_EQ(summary.followed, summary.frames);
  EXPECT_NEAR(summary.path_m, 480 / kWallFocalPx * kWallM, 0.3);
  EXPECT_TRUE(summary.hard.empty());
}

TEST_F(WalkGuideTest, AFastWalkIsToBeSlower) {
  const GuideStep last = walk(&wall_, 0, 560, 70);  // 2.8 focal lengths a second
  EXPECT_TRUE(last.advice & kSlower);
  EXPECT_FALSE(allAdvice() & kGoBack);
  ASSERT_EQ(guide_.summary().hard.size(), 1u);
  EXPECT_TRUE(guide_.summary().hard[0].advice & kSlower);
}

TEST_F(WalkGuideTest, DarkFramesNeedLight) {
  walk(&wall_, 0, 200, 20);
  EXPECT_TRUE(look(&wall_, 200, 0.04).advice & kMoreLight);
  EXPECT_EQ(look(&wall_, 200).advice, 0u);
}

TEST_F(WalkGuideTest, AWalkMayBeginInTheDark) {
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(look(&wall_, 20 * i, 0.08).advice & kMoreLight) << i;
  EXPECT_FALSE(allAdvice() & kGoBack);
  EXPECT_EQ(guide_.summary().followed, 10u);
}

TEST_F(WalkGuideTest, FramesWithoutDepthNeedAnotherDistance) {
  walk(&wall_, 0, 200, 20);
  EXPECT_TRUE(look(&wall_, 200, 1, false).advice & kOtherRange);
  EXPECT_EQ(look(&wall_, 200).advice, 0u);
}

TEST_F(WalkGuideTest, WhoReturnsIsToldWhereTo) {
  walk(&wall_, 0, 800, 20);
  EXPECT_TRUE(loops().empty());
  walk(&wall_, 800, 0, 20);
  ASSERT_EQ(loops().size(), 1u);
  EXPECT_EQ(steps_.back().loops, 1u);
  const GuideStep &closed = *std::find_if(steps_.begin(), steps_.end(), [](const auto &s) { return s.loop; });
  // Where both were: a frame each 20 px on the way there, and on the way back.
  const int there_px = 20 * static_cast<int>(closed.loop->time_then_ns / kPeriodNs - 1),
            back_px = 800 - 20 * static_cast<int>(closed.time_ns / kPeriodNs - 42);
  EXPECT_NEAR(closed.loop->now_from_then.translation_m.x(), (there_px - back_px) / kWallFocalPx * kWallM, 0.02);
  EXPECT_EQ(guide_.summary().parts, 1u);
  EXPECT_TRUE(guide_.summary().begin_seen_again);
  EXPECT_GE(guide_.summary().seen_again, 3u);
  EXPECT_LE(2 * guide_.summary().seen_again, guide_.summary().places) << "those on the way back were seen once";
  EXPECT_EQ(allAdvice(), 0u);
}

TEST_F(WalkGuideTest, WhoIsLostIsSentBackAndIsFoundAgain) {
  MadeUpWall elsewhere(2);
  walk(&wall_, 0, 400, 20);
  EXPECT_FALSE(walk(&elsewhere, 0, 160, 20).advice & kGoBack);  // not at once
  const GuideStep lost = walk(&elsewhere, 160, 300, 20);
  EXPECT_TRUE(lost.advice & kGoBack);
  EXPECT_NEAR(lost.lost_s, 1.7, 0.01);
  EXPECT_EQ(lost.parts, 2u);
  EXPECT_EQ(guide_.summary().parts, 2u);
  EXPECT_TRUE(guide_.summary().hard.at(0).advice & kGoBack);
  const GuideStep found = walk(&wall_, 400, 200, 20);
  EXPECT_EQ(found.advice, 0u);
  EXPECT_GE(found.loops, 1u);
  EXPECT_EQ(guide_.summary().parts, 2u);  // what was seen elsewhere never met the rest
  EXPECT_NEAR(guide_.summary().hard.at(0).from_s, 2.1, 0.01);
}

// A glance elsewhere costs nothing.
TEST_F(WalkGuideTest, AFrameThatAgreesWithNothingIsForgotten) {
  MadeUpWall elsewhere(2);
  walk(&wall_, 0, 200, 20);
  look(&elsewhere, 0);
  const GuideStep back = walk(&wall_, 200, 400, 20);
  EXPECT_EQ(back.parts, 1u);
  EXPECT_EQ(allAdvice(), 0u);
  const WalkSummary summary = guide_.summary();
  EXPECT_EQ(summary.followed + 1, summary.frames);
  EXPECT_TRUE(summary.hard.empty());
}

}  // namespace
}  // namespace sphc::host
