// What an expected pose and a known vertical are good for.
#include <gtest/gtest.h>

#include "runtime/stages/pose/estimator.h"
#include "tests/support/random_numbers.h"
#include "tests/support/sensor_world.h"
#include "tests/unit/runtime/stages/pose/pose_test_estimator.h"

namespace sphc {
namespace {

constexpr double kDegree = kPi / 180;

test::PoseWorld worldAt(double eta, uint64_t seed) {
  test::SensorWorldOptions options;
  options.seed = seed;
  options.true_share = eta;
  return test::makeSensorWorld(options);
}

Estimate searchWith(test::TestEstimator *estimator, const test::PoseWorld &world, const PosePrior *prior,
                    uint64_t seed) {
  PoseQuery query;
  query.seed = seed;
  query.prior = prior;
  return estimator->search(world, query);
}

TEST(PosePrior, WhenRightItIsVerifiedWithoutSampling) {
  test::TestEstimator estimator;
  int verified = 0, found = 0;
  for (uint64_t seed = 1; seed <= 200; ++seed) {
    const test::PoseWorld world = worldAt(0.25, seed);
    const PosePrior prior = test::odometerPrior(world, 0.5 * kDegree, 0.01, seed);
    const Estimate estimate = searchWith(&estimator, world, &prior, seed);
    verified += estimate.iterations == 0;
    found += isFound(estimate, world);
  }
  RecordProperty("sampled_of_200", 200 - verified);
  EXPECT_GE(verified, 190);
  EXPECT_GE(found, 199);
}

TEST(PosePrior, WhenVagueItIsFoundAllTheSame) {
  test::TestEstimator estimator;
  int found = 0;
  for (uint64_t seed = 1; seed <= 200; ++seed) {
    const test::PoseWorld world = worldAt(0.25, seed);
    const PosePrior prior = test::odometerPrior(world, 5 * kDegree, 0.3, seed);
    found += isFound(searchWith(&estimator, world, &prior, seed), world);
  }
  RecordProperty("missed_of_200", 200 - found);
  EXPECT_GE(found, 199);
}

// An odometer that lies: far off, and sure of it.
void expectRightInSpiteOf(double off_rad, double off_m, double sigma_rad, double sigma_m) {
  test::TestEstimator estimator;
  int found = 0;
  for (uint64_t seed = 1; seed <= 100; ++seed) {
    const test::PoseWorld world = worldAt(0.25, seed);
    Random random(seed);
    PosePrior prior = test::odometerPrior(world, 0, 0, seed);
    const Rigid off = {rotationFromVector(off_rad * test::randomDirection(&random)),
                       off_m * test::randomDirection(&random)};
    prior.camera_from_map = off * prior.camera_from_map;
    prior.rotation_sigma_rad = sigma_rad;
    prior.translation_sigma_m = sigma_m;
    found += isFound(searchWith(&estimator, world, &prior, seed), world);
  }
  ::testing::Test::RecordProperty("missed_of_100", 100 - found);
  EXPECT_EQ(found, 100);
}

TEST(PosePrior, WhenWrongItDoesNotMatter) { expectRightInSpiteOf(40 * kDegree, 2, 2 * kDegree, 0.05); }
TEST(PosePrior, WhenWrongAndWideItDoesNotMatter) { expectRightInSpiteOf(90 * kDegree, 3, 15 * kDegree, 0.5); }
TEST(PosePrior, WhenALittleWrongItDoesNotMatter) { expectRightInSpiteOf(8 * kDegree, 0.3, 1 * kDegree, 0.03); }

TEST(PosePrior, OfAFewFakesIsNotBelieved) {
  test::TestEstimator estimator;
  int believed = 0;
  for (uint64_t seed = 1; seed <= 100; ++seed) {
    const test::PoseWorld world = worldAt(0, seed);
    const PosePrior prior = test::odometerPrior(world, 5 * kDegree, 0.2, seed);
    const Estimate estimate = searchWith(&estimator, world, &prior, seed);
    believed += estimator.judge(world, estimate) == Outcome::kLocalized;
  }
  EXPECT_EQ(believed, 0);
}

struct PriorEffort {
  double iterations = 0, hypotheses = 0;
  int found = 0;
};
PriorEffort effortWith(double up_sigma_rad, double eta, int worlds) {
  test::TestEstimator estimator;
  PriorEffort effort;
  for (int i = 1; i <= worlds; ++i) {
    const uint64_t seed = static_cast<uint64_t>(i);
    const test::PoseWorld world = worldAt(eta, seed);
    const PosePrior prior = test::gravityPrior(world, up_sigma_rad, seed);
    const Estimate estimate = searchWith(&estimator, world, up_sigma_rad > 0 ? &prior : nullptr, seed);
    effort.iterations += static_cast<double>(estimate.iterations) / worlds;
    effort.hypotheses += static_cast<double>(estimate.hypotheses) / worlds;
    effort.found += isFound(estimate, world);
  }
  return effort;
}

TEST(GravityPrior, NeedsAThirdOfTheHypotheses) {
  const PriorEffort plain = effortWith(0, 0.25, 1000), half_a_degree = effortWith(0.5 * kDegree, 0.25, 1000);
  RecordProperty("hypotheses_plain", std::to_string(plain.hypotheses));
  RecordProperty("hypotheses_upright", std::to_string(half_a_degree.hypotheses));
  RecordProperty("found_plain", plain.found);
  RecordProperty("found_upright", half_a_degree.found);
  EXPECT_GE(half_a_degree.found, plain.found);
  EXPECT_LT(3 * half_a_degree.hypotheses, plain.hypotheses);
}

TEST(GravityPrior, AVerticalOfADegreeStillFinds) {
  const PriorEffort effort = effortWith(1 * kDegree, 0.25, 300);
  RecordProperty("iterations", std::to_string(effort.iterations));
  RecordProperty("missed_of_300", 300 - effort.found);
  EXPECT_GE(effort.found, 297);
}

TEST(GravityPrior, MakesThePoseMoreExact) {
  test::TestEstimator estimator;
  double with = 0, without = 0;
  for (uint64_t seed = 1; seed <= 100; ++seed) {
    const test::PoseWorld world = worldAt(0.33, seed);
    const PosePrior prior = test::gravityPrior(world, 0.02 * kDegree, seed);
    const Rigid plain = searchWith(&estimator, world, nullptr, seed).camera_from_map;
    const Rigid upright = searchWith(&estimator, world, &prior, seed).camera_from_map;
    without += test::rotationErrorRad(plain, world.camera_from_map);
    with += test::rotationErrorRad(upright, world.camera_from_map);
  }
  EXPECT_LT(with, 0.9 * without);
}

}  // namespace
}  // namespace sphc
