#include "runtime/localizer/hypothesis_search.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "runtime/localizer/tuning.h"
#include "tests/unit/runtime/localizer/verification_fixture.h"

namespace sphc {
namespace {

using namespace tuning;

class HypothesisSearchTest : public test::VerificationTest {};

TEST_F(HypothesisSearchTest, GuidedRematchingAsksEveryKeypointNearThePose) {
  constexpr uint32_t kFirst = 80;
  verify(seen(1, 0, kFirst));
  ASSERT_TRUE(found().isLocalized());
  const auto matches = found().matched.matches();
  const auto is_new = [&](const Match &match) { return match.query >= kFirst; };
  EXPECT_GT(std::count_if(matches.begin(), matches.end(), is_new), 40);
  for (const Correspondence &c : found().matched.ofThisFrame())
    EXPECT_LT(parts_.angleOff(c, found().estimate.camera_from_map), kConesOfSearchedPose[1] + degrees(0.5));
}

TEST_F(HypothesisSearchTest, TooFewMatchesAreNotSearched) {
  const PoseTask task = seen(0);
  found().matched.assign(kFewestMatches - 1, parts_.front, parts_.search.map(0));
  verify(task);
  EXPECT_EQ(found().outcome, Outcome::kFewMatches);
  EXPECT_EQ(parts_.work.samples, 0u);
}

TEST_F(HypothesisSearchTest, CountsTheSamples) {
  verify(seen(0));
  EXPECT_GT(found().searched.iterations, 0u);
  EXPECT_GE(parts_.work.samples, found().searched.iterations);
}

TEST_F(HypothesisSearchTest, TheDeadlineIsTheReasonWhereItPassed) {
  PoseTask task = seen(0);
  task.query.deadline = Deadline::after({[](void *) { return int64_t{10}; }, nullptr}, 0, 1);
  verify(task);
  EXPECT_EQ(found().outcome, Outcome::kDeadline);
}

TEST_F(HypothesisSearchTest, FewerInliersThanTheConfigAsksForAreNotBelieved) {
  min_inliers_ = 5000;
  verify(seen(0));
  EXPECT_EQ(found().outcome, Outcome::kNoConsensus);
  EXPECT_LT(errorM(0), 0.02);
}

// In a narrow cone more agrees by chance.
TEST_F(HypothesisSearchTest, AgreementWhereThePoseWasExpectedProvesLess) {
  PoseTask task = seen(0);
  verify(task);
  const double everywhere = found().evidence.log_chance_first;
  task = seen(0);
  task.solid_angle_sr = solidAngleOf(degrees(5));
  found().guided = true;
  verify(task);
  EXPECT_EQ(found().evidence.source, MatchSource::kExpected);
  EXPECT_GT(found().evidence.log_chance_first, everywhere + 10);
}

TEST_F(HypothesisSearchTest, RaysTakePartInGuidedRematching) {
  PoseTask task = seen(0);
  const uint32_t lifted = parts_.front.liftedCount();
  ASSERT_LT(lifted, parts_.front.keypointCount()) << "the frame has no keypoint without depth";
  const Match rays[] = {{lifted, 5, 10, 40}};
  task.rays = {rays, 1};
  verify(task);
  const auto matches = found().matched.matches();
  ASSERT_FALSE(matches.empty());
  EXPECT_EQ(matches[matches.size() - 1].query, lifted);
  EXPECT_EQ(matches[matches.size() - 1].point_index, 5u);
}

// What earlier frames matched stands behind this frame's matches, after every guided re-matching, and proves
// nothing about it.
TEST_F(HypothesisSearchTest, EarlierFramesTakePartWhereTheyWerePutTogether) {
  Tracker tracker;
  const Odometry still = {{}, 1e-4, 1e-4};
  tracker.advance(1000, &still);
  seen(0);
  parts_.fusion.remember(0, found().matched);
  tracker.advance(1000 + 33000000, &still);
  parts_.fusion.advance(tracker);

  verify(seen(0, 0, 60));
  EXPECT_EQ(found().matched.all().size(), found().matched.matches().size());
  const double alone = found().evidence.log_chance_second;
  const PoseTask task = seen(0, 0, 60);
  found().begin(0, 2);
  parts_.search.matchEverywhere(task.question, 60, {}, &found().matched, &parts_.work);
  verify(task);
  EXPECT_EQ(found().frames, 2u);
  EXPECT_GT(found().matched.all().size(), found().matched.matches().size());
  EXPECT_NEAR(found().evidence.log_chance_second, alone, 0.1 * -alone);
}

TEST_F(HypothesisSearchTest, AmongManyInliersAFewHaveNoSay) {
  verify(seen(0));
  ASSERT_GT(found().estimate.inliers, kInliersBeyondChallenge);
  EXPECT_EQ(found().leverage.indices.size(), 0u);
  EXPECT_EQ(found().evidence.centre_sigma_ratio, 1);
}

}  // namespace
}  // namespace sphc
