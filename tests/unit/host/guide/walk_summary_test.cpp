#include "host/guide/walk_summary.h"

#include <gtest/gtest.h>

namespace sphc::host {
namespace {

constexpr int64_t kStepNs = 100000000;

GuidePlace placeAt(uint32_t part, double x_m, uint32_t support) {
  GuidePlace place;
  place.part = part;
  place.part_from_camera.translation_m.x() = x_m;
  place.support = support;
  return place;
}

TEST(WalkSummaryTest, OfNothingIsNothing) {
  const WalkSummary summary = summaryOf({}, {}, UINT32_MAX, 0);
  EXPECT_EQ(summary.frames, 0u);
  EXPECT_TRUE(summary.hard.empty());
}

TEST(WalkSummaryTest, StretchesAreJoinedOverShortGapsAndSaysWhatHalfOfThemHave) {
  std::vector<Look> looks;
  for (int64_t i = 0; i < 40; ++i) looks.push_back({i * kStepNs, 0, 0});
  for (const size_t i : {10, 11, 12, 15}) looks[i].advice = kMoreLight;
  looks[11].advice |= kSlower;
  looks[30].advice = kOtherRange;  // one frame is no stretch
  const WalkSummary summary = summaryOf(looks, {placeAt(0, 0, 100)}, 0, 0);
  ASSERT_EQ(summary.hard.size(), 1u);
  EXPECT_NEAR(summary.hard[0].from_s, 1.0, 1e-9);
  EXPECT_NEAR(summary.hard[0].to_s, 1.5, 1e-9);
  EXPECT_EQ(summary.hard[0].advice, kMoreLight);
}

TEST(WalkSummaryTest, HardFramesOfASlowRecordingAreOneStretch) {
  constexpr int64_t kSecond = 1000000000;
  std::vector<Look> looks;
  for (int64_t i = 0; i < 20; ++i) looks.push_back({i * kSecond, 0, 0});
  for (const size_t i : {5, 6, 7, 15, 16}) looks[i].advice = kMoreLight;
  const WalkSummary summary = summaryOf(looks, {placeAt(0, 0, 100)}, 0, 0);
  ASSERT_EQ(summary.hard.size(), 2u);
  EXPECT_NEAR(summary.hard[0].from_s, 5, 1e-9);
  EXPECT_NEAR(summary.hard[0].to_s, 7, 1e-9);
}

TEST(WalkSummaryTest, OtherPartsAndWeakPlacesAreHard) {
  const std::vector<GuidePlace> places = {placeAt(0, 0, 100), placeAt(0, 3, 20), placeAt(1, 0, 100)};
  std::vector<Look> looks;
  for (int64_t i = 0; i < 30; ++i)
    looks.push_back({i * kStepNs, 0, static_cast<uint32_t>(i < 10 ? 0 : i < 12 ? 1 : i < 20 ? 0 : 2)});
  const WalkSummary summary = summaryOf(looks, places, 0, 0);
  ASSERT_EQ(summary.hard.size(), 2u);
  EXPECT_EQ(summary.hard[0].advice, kLookAgain);
  EXPECT_EQ(summary.hard[1].advice, kGoBack);
  EXPECT_EQ(summary.followed, 20u);
  EXPECT_EQ(summary.parts, 2u);
  EXPECT_NEAR(summary.path_m, 3, 1e-9);
}

// As who stands still at the begin.
TEST(WalkSummaryTest, TheOnlyPlaceIsNotThin) {
  std::vector<Look> looks;
  for (int64_t i = 0; i < 10; ++i) looks.push_back({i * kStepNs, 0, 0});
  EXPECT_TRUE(summaryOf(looks, {placeAt(0, 0, 0)}, 0, 0).hard.empty());
  EXPECT_EQ(summaryOf(looks, {placeAt(0, 0, 0), placeAt(0, 1, 0)}, 0, 0).hard.size(), 1u);
}

}  // namespace
}  // namespace sphc::host
