#include "host/guide/guide_words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/guide/advice.h"

namespace sphc::host {
namespace {

using testing::HasSubstr;

GuideStep saidAt(double seconds, GuideAdvice advice) {
  GuideStep step;
  step.time_ns = static_cast<int64_t>(1e9 * seconds);
  step.advice = advice;
  return step;
}

TEST(GuideLineTest, WhatComesOnceIsNotSaid) {
  GuideLine line;
  EXPECT_EQ(line.hear(saidAt(0.1, kSlower)), "good");
  EXPECT_EQ(line.hear(saidAt(0.2, 0)), "good");
  EXPECT_EQ(line.hear(saidAt(0.3, kSlower)), "good");
  EXPECT_EQ(line.hear(saidAt(0.4, kSlower)), "slower");
}

TEST(GuideLineTest, WhatWasSaidStaysUnlessSomethingMoreUrgentComes) {
  GuideLine line;
  line.hear(saidAt(0.1, kSlower));
  line.hear(saidAt(0.2, kSlower));
  EXPECT_EQ(line.hear(saidAt(0.3, kLookAgain)), "slower");
  EXPECT_EQ(line.hear(saidAt(0.4, kLookAgain)), "slower");
  line.hear(saidAt(0.5, kMoreLight));
  EXPECT_EQ(line.hear(saidAt(0.6, kMoreLight)), "more light");
  EXPECT_EQ(line.hear(saidAt(1.9, 0)), "more light");
  EXPECT_EQ(line.hear(saidAt(2.2, 0)), "good");
}

TEST(GuideLineTest, WhoIsLostIsToldTheCauseToo) {
  GuideLine line;
  GuideStep step = saidAt(12, kGoBack | kMoreLight);
  step.lost_s = 7.4;
  EXPECT_EQ(line.hear(step), "LOST: go back to where you were 7 s ago (more light)");
}

// In a part of its own, which hangs together weakly.
TEST(GuideLineTest, WhoIsLostIsNotToldToLookAgain) {
  GuideLine line;
  GuideStep step = saidAt(12, kGoBack | kLookAgain);
  step.lost_s = 3;
  EXPECT_EQ(line.hear(step), "LOST: go back to where you were 3 s ago");
}

TEST(GuideLineTest, ALoopIsSaid) {
  GuideLine line;
  GuideStep step = saidAt(30, 0);
  step.loop = ClosedLoop();
  step.loop->time_then_ns = 9000000000;
  EXPECT_THAT(line.hear(step), HasSubstr("where you were 21 s ago"));
  EXPECT_THAT(line.hear(saidAt(32, 0)), HasSubstr("21 s ago"));
  EXPECT_EQ(line.hear(saidAt(33.5, 0)), "good");
}

TEST(GuideWordsTest, ProgramsGetNamesAndTheLoop) {
  GuideStep step = saidAt(1, kMoreLight | kSlower);
  step.loop = ClosedLoop();
  step.loop->is_begin = true;
  const nlohmann::ordered_json json = stepJson(step);
  EXPECT_EQ(json["advice"], "too dark, too fast");
  EXPECT_EQ(json["loop"]["is_begin"], true);
  EXPECT_FALSE(json.contains("lost_s"));
}

TEST(GuideWordsTest, NextStepsAreOfWhatIsMissing) {
  WalkSummary summary;
  summary.frames = 10;
  summary.followed = 8;
  summary.hard = {{1, 2, kGoBack}};
  EXPECT_THAT(nextSteps(summary), HasSubstr("lost"));
  EXPECT_THAT(nextSteps(summary), HasSubstr("no loop"));
  summary.hard = {{1, 2, kSlower}};  // two glances elsewhere besides, which the table does not name
  EXPECT_THAT(nextSteps(summary), testing::Not(HasSubstr("lost")));
  summary.followed = 4;
  EXPECT_THAT(nextSteps(summary), HasSubstr("lost"));
  summary.followed = 10;
  summary.loops = 1;
  EXPECT_EQ(nextSteps(summary), "");
}

}  // namespace
}  // namespace sphc::host
