#include "runtime/localizer/judgement.h"

#include <gtest/gtest.h>

#include <limits>

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

TEST(Judgement, ClearMajorityIsBelieved) { EXPECT_EQ(judgePose(sureEstimate(60), 100, 10), SPHC_OUTCOME_LOCALIZED); }

TEST(Judgement, FewerThanTheConfigAsksForAreNot) {
  EXPECT_EQ(judgePose(sureEstimate(60), 100, 61), SPHC_OUTCOME_NO_CONSENSUS);
}

TEST(Judgement, WhatChanceWouldDoIsNot) {
  EXPECT_EQ(judgePose(sureEstimate(12), 100, 10), SPHC_OUTCOME_NO_CONSENSUS);
  EXPECT_EQ(judgePose(sureEstimate(20), 150, 10), SPHC_OUTCOME_NO_CONSENSUS);
  EXPECT_EQ(judgePose(sureEstimate(0), 0, 4), SPHC_OUTCOME_NO_CONSENSUS);
}

TEST(Judgement, AVaguePoseIsUncertain) {
  Estimate estimate = sureEstimate(80);
  estimate.covariance(4, 4) = 0.05 * 0.05;
  EXPECT_EQ(judgePose(estimate, 100, 10), SPHC_OUTCOME_UNCERTAIN);
  estimate = sureEstimate(80);
  estimate.covariance(0, 0) = 0.03 * 0.03;
  EXPECT_EQ(judgePose(estimate, 100, 10), SPHC_OUTCOME_UNCERTAIN);
  estimate.covariance(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(judgePose(estimate, 100, 10), SPHC_OUTCOME_UNCERTAIN);
}

// What counts is the camera's place: a rotation about the camera itself moves the map's origin, however far it is.
TEST(Judgement, ADistantOriginIsNoUncertainty) {
  Estimate estimate = sureEstimate(80);
  estimate.camera_from_map.translation_m = Vector3(30, 0, 0);
  const double sigma = 0.003;
  Eigen::Matrix<double, 6, 3> about_camera;  // omega moves the origin's image by omega x t
  about_camera << Matrix3::Identity(), -crossMatrix(estimate.camera_from_map.translation_m);
  estimate.covariance = 1e-8 * Matrix6::Identity() + sigma * sigma * about_camera * about_camera.transpose();
  EXPECT_GT(estimate.covariance(4, 4), 0.08 * 0.08);
  EXPECT_EQ(judgePose(estimate, 100, 10), SPHC_OUTCOME_LOCALIZED);
}

TEST(Judgement, RandomOutliersAreNotAccepted) {
  test::TestEstimator estimator(400, 2000);
  for (uint64_t seed = 1; seed <= 60; ++seed) {
    test::PoseWorldOptions options;
    options.seed = seed;
    options.true_share = 0;
    options.count = 20 + 6 * seed;
    const Estimate estimate = estimator.search(test::makePoseWorld(options), seed);
    EXPECT_NE(judgePose(estimate, static_cast<uint32_t>(options.count), 10), SPHC_OUTCOME_LOCALIZED)
        << estimate.inliers << " of " << options.count;
  }
}

}  // namespace
}  // namespace sphc
