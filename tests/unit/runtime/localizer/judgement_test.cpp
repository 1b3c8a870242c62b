#include "runtime/localizer/judgement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/support/pose_world.h"
#include "tests/support/random_numbers.h"
#include "tests/unit/runtime/stages/pose/pose_test_estimator.h"

namespace sphc {
namespace {

Estimate sureEstimate(uint32_t inliers) {
  Estimate estimate;
  estimate.inliers = inliers;
  estimate.covariance = 1e-6 * Matrix6::Identity();
  return estimate;
}

constexpr Evidence kStrong = {60, -40, -30};

TEST(Judgement, StrongEvidenceIsBelieved) {
  EXPECT_EQ(judgePose(kStrong, sureEstimate(60), 10), Outcome::kLocalized);
}

TEST(Judgement, FewerThanTheConfigAsksForAreNot) {
  EXPECT_EQ(judgePose(kStrong, sureEstimate(60), 61), Outcome::kNoConsensus);
}

TEST(Judgement, WhatChanceWouldDoIsNot) {
  EXPECT_EQ(judgePose({60, 0, 0}, sureEstimate(60), 10), Outcome::kNoConsensus);
  EXPECT_EQ(judgePose({60, -4, -3}, sureEstimate(60), 10), Outcome::kNoConsensus);
  EXPECT_EQ(judgePose({60, 9, -15}, sureEstimate(60), 10), Outcome::kNoConsensus);  // many poses were tried
}

TEST(Judgement, EvidenceFromTheSameMatchesCountsOnce) {
  Evidence evidence = {60, -5, -20, MatchSource::kExpected};
  EXPECT_EQ(judgePose(evidence, sureEstimate(60), 10), Outcome::kNoConsensus);
  evidence.log_chance_first = -20;
  EXPECT_EQ(judgePose(evidence, sureEstimate(60), 10), Outcome::kLocalized);
  evidence.log_chance_second = -5;
  EXPECT_EQ(judgePose(evidence, sureEstimate(60), 10), Outcome::kNoConsensus);
}

TEST(Judgement, WhereAPoseIsExpectedLessEvidenceIsEnough) {
  EXPECT_EQ(judgePose({60, -8, -9, MatchSource::kExpected}, sureEstimate(60), 10), Outcome::kLocalized);
  EXPECT_EQ(judgePose({60, 0, -8, MatchSource::kGlobal}, sureEstimate(60), 10), Outcome::kNoConsensus);
}

TEST(Judgement, WhatRestsOnFewMatchesIsUncertain) {
  Estimate estimate = sureEstimate(20);
  estimate.covariance.bottomRightCorner<3, 3>() = 0.01 * 0.01 * Matrix3::Identity();
  Evidence evidence = {20, -40, -30};
  EXPECT_EQ(judgePose(evidence, estimate, 10), Outcome::kLocalized);
  evidence.centre_sigma_ratio = 4;
  EXPECT_EQ(judgePose(evidence, estimate, 10), Outcome::kUncertain);
}

// As of a depth noise of micrometres.
TEST(Judgement, ANegativeVarianceIsUncertain) {
  Estimate estimate = sureEstimate(80);
  estimate.covariance(4, 4) = -1e-6;
  EXPECT_EQ(judgePose(kStrong, estimate, 10), Outcome::kUncertain);
}

TEST(Judgement, AVaguePoseIsUncertain) {
  Estimate estimate = sureEstimate(80);
  estimate.covariance(4, 4) = 0.07 * 0.07;
  EXPECT_EQ(judgePose(kStrong, estimate, 10), Outcome::kUncertain);
  estimate = sureEstimate(80);
  estimate.covariance(0, 0) = 0.04 * 0.04;
  EXPECT_EQ(judgePose(kStrong, estimate, 10), Outcome::kUncertain);
  estimate.covariance(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(judgePose(kStrong, estimate, 10), Outcome::kUncertain);
}

// What counts is the camera's place: with T = exp(xi) T_estimate a turn of the camera about itself is all rotation,
// however far the map's origin.
TEST(Judgement, ADistantOriginIsNoUncertainty) {
  Estimate estimate = sureEstimate(80);
  estimate.camera_from_map.translation_m = Vector3(30, 0, 0);
  estimate.covariance.setZero();
  estimate.covariance.topLeftCorner<3, 3>() = 0.003 * 0.003 * Matrix3::Identity();
  EXPECT_EQ(judgePose(kStrong, estimate, 10), Outcome::kLocalized);
  estimate.covariance.bottomRightCorner<3, 3>() = 0.08 * 0.08 * Matrix3::Identity();
  EXPECT_EQ(judgePose(kStrong, estimate, 10), Outcome::kUncertain);
}

TEST(Judgement, RandomOutliersAreNotAccepted) {
  test::TestEstimator estimator(400, 2000);
  for (uint32_t seed = 1; seed <= 60; ++seed) {
    test::PoseWorldOptions options;
    options.seed = seed;
    options.true_share = 0;
    options.count = 20 + 6 * seed;
    const test::PoseWorld world = test::makePoseWorld(options);
    const Estimate estimate = estimator.search(world, seed);
    EXPECT_NE(estimator.judge(world, estimate), Outcome::kLocalized) << estimate.inliers << " of " << options.count;
  }
}

// Where a pose is expected, all map directions that are looked at lie near the predicted ones, which helps a wrong
// pose: still none of these, of which not one is right, may pass.
TEST(Judgement, RandomDirectionsNearAnExpectedPoseAreNotAccepted) {
  test::TestEstimator estimator(400, 2000);
  constexpr double kCone = 2.5 * kPi / 180;
  for (uint32_t seed = 1; seed <= 300; ++seed) {
    test::PoseWorldOptions options;
    options.seed = seed;
    options.true_share = 0;
    options.count = 20 + 20 * (seed % 10);
    options.cone_rad = kCone;
    const test::PoseWorld world = test::makePoseWorld(options);
    EXPECT_NE(estimator.judgeExpected(world, kCone), Outcome::kLocalized) << seed;
  }
}

TEST(Judgement, ATruePoseNearTheExpectedOneIsAccepted) {
  test::TestEstimator estimator(400, 2000);
  constexpr double kCone = 2.5 * kPi / 180;
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    test::PoseWorldOptions options;
    options.seed = seed;
    options.true_share = 0.7;
    options.cone_rad = kCone;
    options.centre_offset_m = Vector3(0, 0, 2);
    const test::PoseWorld world = test::makePoseWorld(options);
    EXPECT_EQ(estimator.judgeExpected(world, kCone), Outcome::kLocalized) << seed;
  }
}

TEST(Judgement, ATruePoseAmongOutliersIsAccepted) {
  test::TestEstimator estimator(400, 20000);
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    test::PoseWorldOptions options;
    options.seed = seed;
    options.true_share = 0.25;
    const test::PoseWorld world = test::makePoseWorld(options);
    EXPECT_EQ(estimator.judge(world, estimator.search(world, seed)), Outcome::kLocalized) << seed;
  }
}

// The bound must hold: agreement by chance is at least as rare as it says.
TEST(Judgement, ChanceOfAgreement) {
  test::PoseWorldOptions options;
  const test::PoseWorld world = test::makePoseWorld(options);
  const Span<const Correspondence> all = {world.correspondences.data(), world.correspondences.size()};
  const auto chance = [&](uint32_t inliers, double solid_angle) {
    return logChanceOfAgreement(all, world.camera_from_map, inliers, {1, 12, solid_angle});
  };
  EXPECT_EQ(chance(3, 4 * kPi), 0);
  EXPECT_EQ(chance(0, 4 * kPi), 0);
  EXPECT_LT(chance(100, 4 * kPi), chance(50, 4 * kPi));  // more agreement is rarer
  EXPECT_LT(chance(100, 4 * kPi), chance(100, 0.1));     // in a narrower cone it is commoner
  EXPECT_EQ(chance(100, 1e-12), 0);
  EXPECT_TRUE(isFinite(chance(300, 4 * kPi)));
}

// Of matches that look from the sphere's centre each region is a circle: where all agree, chance would have to find
// each but those that the pose was made from.
TEST(Judgement, TheChanceThatAllAgreeIsThatOfEachButAMinimalSample) {
  constexpr double kSigmaM = 0.01, kDistanceM = 2, kThreshold2 = 9;
  constexpr uint32_t kMatches = 20;
  const Correspondence one = {{Vector3(0, 0, kDistanceM), kSigmaM, 0.02}, Vector3::UnitZ()};
  const std::vector<Correspondence> all(kMatches, one);
  const Span<const Correspondence> span = {all.data(), all.size()};
  const double share = kPi * kThreshold2 * kSigmaM * kSigmaM / (kDistanceM * kDistanceM * 4 * kPi);
  EXPECT_NEAR(logChanceOfAgreement(span, Rigid(), kMatches, {1, kThreshold2, 4 * kPi}),
              (kMatches - kMinimalSample) * std::log(share), 1e-9);
  EXPECT_EQ(logChanceOfAgreement(span, Rigid(), kMinimalSample, {1, kThreshold2, 4 * kPi}), 0);
}

// Seen from the side, noise of depth makes the region larger in which a match agrees by chance.
TEST(Judgement, NoisierDepthAgreesByChanceMoreOften) {
  const std::vector<Correspondence> all(20, {{Vector3(0, 0, 2), 0.005, 0.02}, Vector3::UnitZ()});
  const Span<const Correspondence> span = {all.data(), all.size()};
  const Rigid beside = {Matrix3::Identity(), Vector3(2, 0, 0)};
  const auto chance = [&](double noise_scale) {
    return logChanceOfAgreement(span, beside, 20, {noise_scale, 9, 4 * kPi});
  };
  EXPECT_GT(chance(3), chance(1) + 10);
}

TEST(Judgement, MatchesWithoutDepthAreNoWitnesses) {
  std::vector<Correspondence> all(20, {{Vector3(0, 0, 2), 0.005, 0.02}, Vector3::UnitZ()});
  const auto chance = [&] { return logChanceOfAgreement({all.data(), all.size()}, Rigid(), 15, {1, 9, 4 * kPi}); };
  const double of_lifted = chance();
  all.resize(60, {{Vector3::UnitZ(), 0.005, std::numeric_limits<double>::infinity()}, Vector3::UnitZ()});
  EXPECT_EQ(chance(), of_lifted);
}

}  // namespace
}  // namespace sphc
