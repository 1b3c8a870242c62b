#include "runtime/stages/pose/confidence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/random_numbers.h"

namespace sphc {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Matrix6 covarianceOf(double rotation_sigma_rad, double translation_sigma_m) {
  const double turn2 = rotation_sigma_rad * rotation_sigma_rad / 3;
  const double shift2 = translation_sigma_m * translation_sigma_m / 3;
  return (Vector6() << turn2, turn2, turn2, shift2, shift2, shift2).finished().asDiagonal();
}

Estimate estimateOf(uint32_t inliers, double unit_variance) {
  Estimate estimate;
  estimate.inliers = inliers;
  estimate.unit_variance = unit_variance;
  estimate.covariance = covarianceOf(0.002, 0.01);
  return estimate;
}

TEST(StatedCovariance, GrowsWithTheScatterOfTheInliers) {
  const Matrix6 as_expected = statedCovariance(estimateOf(80, 1)), wider = statedCovariance(estimateOf(80, 2.5));
  EXPECT_TRUE(wider.isApprox(2.5 * as_expected));
}

TEST(StatedCovariance, FewInliersAreWorthLessThanTheySay) {
  double before = kInfinity;
  for (uint32_t inliers : {10u, 20u, 50u, 100u, 1000u}) {
    const double scale =
        std::sqrt(statedCovariance(estimateOf(inliers, 1))(3, 3) / covarianceOf(0.002, 0.01)(3, 3));
    EXPECT_LT(scale, before) << inliers;
    EXPECT_GT(scale, 0.9) << inliers;
    before = scale;
  }
  EXPECT_LT(before, 1);
}

TEST(Confidence, IsHighForAGoodPoseAndLowForABadOne) {
  EXPECT_GT(confidenceOf(covarianceOf(0.005, 0.01)), 0.99);
  EXPECT_NEAR(confidenceOf(covarianceOf(0.005, 0.05)), 0.5, 0.05);
  EXPECT_LT(confidenceOf(covarianceOf(0.005, 0.2)), 0.02);
  EXPECT_LT(confidenceOf(covarianceOf(0.4, 0.01)), 0.02);
}

TEST(Confidence, NeverFallsWhenASigmaShrinksOrABoundGrows) {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const double turn = test::uniformIn(&random, 0, 0.5), shift = test::uniformIn(&random, 0, 0.5);
    const double confidence = confidenceOf(covarianceOf(turn, shift)), less = random.uniform();
    EXPECT_GE(confidenceOf(covarianceOf(less * turn, shift)), confidence);
    EXPECT_GE(confidenceOf(covarianceOf(turn, less * shift)), confidence);
    ErrorBounds wider;
    wider.translation_m *= 1 + less;
    wider.rotation_rad *= 1 + less;
    EXPECT_GE(confidenceOf(covarianceOf(turn, shift), wider), confidence);
  }
}

TEST(Confidence, IsOfTheWorseOfTurnAndShift) {
  const double both = confidenceOf(covarianceOf(0.03, 0.03));
  EXPECT_EQ(confidenceOf(covarianceOf(0.001, 0.03)), both);  // 3 cm of 5 is worse than 1.7 degrees of 5
  EXPECT_GT(confidenceOf(covarianceOf(0.03, 0.001)), both);
}

TEST(Confidence, OtherBoundsAreAskedInTheirOwnMeasure) {
  const double standard = confidenceOf(covarianceOf(0.01, 0.02));
  EXPECT_NEAR(confidenceOf(covarianceOf(0.02, 0.04), {0.10, 10 * kPi / 180}), standard, 1e-12);
  EXPECT_LT(confidenceOf(covarianceOf(0.01, 0.02), {0.01, 5 * kPi / 180}), 0.2);
}

TEST(Confidence, IsAProbabilityWhateverTheInputs) {
  for (double value : {0.0, 1e-300, 1e-9, 0.5, 1.0, 1e9, 1e150}) {
    for (const Matrix6 &covariance : {covarianceOf(value, 0.01), covarianceOf(0.01, value)}) {
      const double confidence = confidenceOf(covariance);
      EXPECT_TRUE(confidence >= 0 && confidence <= 1) << value;
    }
  }
}

TEST(Confidence, WhatIsNotANumberIsNoConfidence) {
  for (double broken : {kNan, -kInfinity, -1.0}) {
    for (int i : {0, 4}) {
      Matrix6 covariance = covarianceOf(0.001, 0.001);
      covariance(i, i) = broken;
      EXPECT_EQ(confidenceOf(covariance), 0) << broken;
    }
    EXPECT_EQ(confidenceOf(covarianceOf(0.001, 0.001), {broken, 1}), 0) << broken;
    EXPECT_EQ(confidenceOf(covarianceOf(0.001, 0.001), {1, broken}), 0) << broken;
  }
}

}  // namespace
}  // namespace sphc
