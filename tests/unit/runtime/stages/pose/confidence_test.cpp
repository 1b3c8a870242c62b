#include "runtime/stages/pose/confidence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/random_numbers.h"

namespace sphc {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Estimate goodEstimate() {
  Estimate estimate;
  estimate.ending = PoseEnding::kFound;
  estimate.lifted = 200;
  estimate.inliers = 80;
  estimate.gain = 65;
  estimate.covariance = Vector6(1e-6, 1e-6, 1e-6, 1e-5, 1e-5, 1e-5).asDiagonal();
  return estimate;
}

double confidenceOf(const Estimate &estimate) { return sphc::confidenceOf(confidenceInputs(estimate, estimate)); }

using Field = double ConfidenceInputs::*;
struct Direction {
  Field field;
  double sign;  // of the change that must not lower the confidence
  double low, high;
};
const Direction kDirections[] = {{&ConfidenceInputs::gain_share, 1, 0, 1},
                                 {&ConfidenceInputs::inliers, 1, 0, 100},
                                 {&ConfidenceInputs::gain_per_inlier, 1, 0, 1},
                                 {&ConfidenceInputs::rotation_sigma_rad, -1, 0, 0.5},
                                 {&ConfidenceInputs::centre_sigma_m, -1, 0, 0.5}};

ConfidenceInputs randomInputs(Random *random) {
  ConfidenceInputs inputs;
  for (const Direction &d : kDirections) inputs.*d.field = test::uniformIn(random, d.low, d.high);
  return inputs;
}

TEST(Confidence, IsHighForAGoodPoseAndLowForABadOne) {
  EXPECT_GT(confidenceOf(goodEstimate()), 0.98);
  Estimate bad = goodEstimate();
  bad.inliers = 5;
  bad.gain = 2.5;
  bad.covariance *= 100;
  EXPECT_LT(confidenceOf(bad), 0.05);
}

TEST(Confidence, NeverFallsWhenAnInputGetsBetter) {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const ConfidenceInputs worse = randomInputs(&random);
    for (const Direction &d : kDirections) {
      ConfidenceInputs better = worse;
      better.*d.field += d.sign * (d.high - d.low) * random.uniform();
      EXPECT_GE(sphc::confidenceOf(better), sphc::confidenceOf(worse));
    }
  }
}

TEST(Confidence, EveryInputCounts) {
  const ConfidenceInputs middling = {0.15, 7, 0.6, 0.02, 0.03};
  for (const Direction &d : kDirections) {
    ConfidenceInputs better = middling, worse = middling;
    better.*d.field *= d.sign > 0 ? 1.5 : 1 / 20.0;
    worse.*d.field *= d.sign > 0 ? 1 / 1.5 : 20.0;
    EXPECT_GT(sphc::confidenceOf(better), sphc::confidenceOf(worse));
  }
}

TEST(Confidence, NoiseBeyondWhatWasStatedLowersIt) {
  Estimate noisy = goodEstimate();
  noisy.inliers = 12;
  noisy.gain = 9;
  const double as_stated = confidenceOf(noisy);
  noisy.noise_ratio = 3;
  EXPECT_LT(confidenceOf(noisy), as_stated);
  noisy.noise_ratio = 0.3;  // less noise is not believed
  EXPECT_EQ(confidenceOf(noisy), as_stated);
}

TEST(Confidence, IsAProbabilityWhateverTheInputs) {
  const double values[] = {-kInfinity, -1e300, -1, -1e-300, 0, 1e-300, 0.5, 1, 1e300, kInfinity};
  for (const Direction &d : kDirections) {
    for (double value : values) {
      ConfidenceInputs inputs = {0.3, 20, 0.8, 0.01, 0.01};
      inputs.*d.field = value;
      const double confidence = sphc::confidenceOf(inputs);
      EXPECT_TRUE(confidence >= 0 && confidence <= 1) << value;
    }
  }
}

TEST(Confidence, WhatIsNotANumberIsNoConfidence) {
  for (const Direction &d : kDirections) {
    ConfidenceInputs inputs = {0.3, 20, 0.8, 0.01, 0.01};
    inputs.*d.field = kNan;
    EXPECT_EQ(sphc::confidenceOf(inputs), 0);
  }
  for (double broken : {kNan, -kInfinity, -1.0}) {
    for (int i : {0, 4}) {
      Estimate estimate = goodEstimate();
      estimate.covariance(i, i) = broken;
      EXPECT_EQ(confidenceOf(estimate), 0) << broken;
    }
  }
}

TEST(Confidence, OfNothingIsLow) {
  EXPECT_LT(confidenceOf(Estimate()), 0.05);
  EXPECT_LT(sphc::confidenceOf(ConfidenceInputs()), 0.05);
}

// A camera that turns about itself: T = exp(omega, 0) T_estimate leaves -R^T t where it was.
TEST(Confidence, LooksAtTheCameraNotAtTheMapsOrigin) {
  Estimate estimate = goodEstimate();
  estimate.camera_from_map.translation_m = {0, 0, 10};
  const Rigid turn = {rotationFromVector({0.01, 0.02, -0.01}), Vector3::Zero()};
  EXPECT_NEAR(
      ((turn * estimate.camera_from_map).inverse().translation_m - estimate.camera_from_map.inverse().translation_m)
          .norm(),
      0, 1e-12);
  estimate.covariance.setZero();
  estimate.covariance.topLeftCorner<3, 3>() = 1e-4 * Matrix3::Identity();
  const ConfidenceInputs inputs = confidenceInputs(estimate, estimate);
  EXPECT_NEAR(inputs.centre_sigma_m, 0, 1e-9);
  EXPECT_NEAR(inputs.rotation_sigma_rad, std::sqrt(3e-4), 1e-9);
}

}  // namespace
}  // namespace sphc
