#include "runtime/stages/pose/estimator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/pose_world.h"
#include "tests/support/random_numbers.h"
#include "tests/support/sensor_world.h"
#include "tests/support/stepping_clock.h"
#include "tests/unit/runtime/stages/pose/pose_test_estimator.h"

namespace sphc {
namespace {

// `most_m`: fakes that agree by chance pull, the more the fewer are true.
void expectExactAt(double eta, uint32_t worlds, double most_m = 2e-3) {
  test::TestEstimator estimator;
  for (uint64_t seed = 1; seed <= worlds; ++seed) {
    test::PoseWorldOptions options;
    options.seed = seed;
    options.true_share = eta;
    const test::PoseWorld world = test::makePoseWorld(options);
    const Estimate estimate = estimator.search(world, seed);
    EXPECT_EQ(estimate.ending, PoseEnding::kFound);
    EXPECT_FALSE(estimate.cut_short);
    EXPECT_LT(test::rotationErrorRad(estimate.camera_from_map, world.camera_from_map), 1e-3) << seed;
    EXPECT_LT(test::translationErrorM(estimate.camera_from_map, world.camera_from_map), most_m) << seed;
    EXPECT_GE(estimate.inliers, static_cast<uint32_t>(eta * 300) - 1) << seed;
    EXPECT_LE(estimate.inliers, static_cast<uint32_t>(eta * 300) + 25) << seed;
  }
}

TEST(Estimator, FindsTheExactPoseAtEta100) { expectExactAt(1, 20); }
TEST(Estimator, FindsTheExactPoseAtEta33) { expectExactAt(0.33, 20); }
TEST(Estimator, FindsTheExactPoseAtEta25) { expectExactAt(0.25, 20); }
TEST(Estimator, FindsTheExactPoseAtEta10) { expectExactAt(0.10, 20, 5e-3); }

test::SensorWorldOptions sensorAt(double eta, uint64_t seed) {
  test::SensorWorldOptions options;
  options.seed = seed;
  options.true_share = eta;
  return options;
}

void expectFoundAt(double eta, int worlds, int at_least) {
  test::TestEstimator estimator;
  int found = 0;
  for (int seed = 1; seed <= worlds; ++seed) {
    const test::PoseWorld world = test::makeSensorWorld(sensorAt(eta, static_cast<uint64_t>(seed)));
    found += isFound(estimator.search(world, static_cast<uint64_t>(seed)), world);
  }
  ::testing::Test::RecordProperty("missed", worlds - found);
  EXPECT_GE(found, at_least) << "of " << worlds;
}

TEST(Estimator, FindsNoisyWorldsAtEta33) { expectFoundAt(0.33, 500, 499); }
TEST(Estimator, FindsNoisyWorldsAtEta25) { expectFoundAt(0.25, 500, 498); }
TEST(Estimator, FindsNoisyWorldsAtEta10) { expectFoundAt(0.10, 100, 98); }

// The same rows with depth, and beside them some without, or not.
TEST(Estimator, RowsWithoutDepthHelp) {
  test::TestEstimator estimator;
  std::vector<double> with, without;
  for (uint64_t seed = 1; seed <= 200; ++seed) {
    test::SensorWorldOptions options = sensorAt(0.5, seed);
    options.depthless_share = 0.6;
    test::PoseWorld world = test::makeSensorWorld(options);
    with.push_back(test::translationErrorM(estimator.search(world, seed).camera_from_map, world.camera_from_map));
    std::vector<Correspondence> &all = world.correspondences;
    all.erase(std::remove_if(all.begin(), all.end(), [](const auto &c) { return !c.lifted.hasDepth(); }),
              all.end());
    without.push_back(
        test::translationErrorM(estimator.search(world, seed).camera_from_map, world.camera_from_map));
  }
  RecordProperty("median_mm_with", std::to_string(1000 * test::median(with)));
  RecordProperty("median_mm_without", std::to_string(1000 * test::median(without)));
  EXPECT_LT(test::median(with), 0.9 * test::median(without));
}

// The noise of depth is as stated.
test::PoseWorldOptions noisyAt(uint64_t seed, double depth_sigma_m, double pixel_sigma_px) {
  test::PoseWorldOptions options;
  options.seed = seed;
  options.depth_sigma_m = options.stated_depth_sigma_m = depth_sigma_m;
  options.pixel_sigma_px = pixel_sigma_px;
  return options;
}

// Equal things that stand in a row: two in five matches are with one of the next two, 8 or 16 cm on.  The sphere
// centre lies to the side, so these agree with their epipolar planes.
TEST(Estimator, MatchesWithTheNextOfARowDoNotPull) {
  test::TestEstimator estimator;
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    test::PoseWorldOptions options = noisyAt(seed, 0.02, 1);
    options.wall_m = 2.5;
    options.centre_offset_m = Vector3(1, 0.1, -2);
    test::PoseWorld world = test::makePoseWorld(options);
    const Rigid map_from_camera = world.camera_from_map.inverse();
    for (size_t i = 0; i < world.correspondences.size(); ++i) {
      Correspondence &c = world.correspondences[i];
      if (i % 5 >= 2) continue;
      const Vector3 on_m(i % 5 == 0 ? 0.08 : 0.16, 0, 0);
      c.direction = (map_from_camera * (c.lifted.point_m + on_m)).normalized();
    }
    const Estimate estimate = estimator.search(world, seed);
    EXPECT_LT(test::translationErrorM(estimate.camera_from_map, world.camera_from_map), 0.02) << seed;
  }
}

TEST(Estimator, WithNoiseTheErrorIsThatOfTheNoise) {
  test::TestEstimator estimator;
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    test::PoseWorldOptions options = noisyAt(seed, 0.015, 0.8);
    options.true_share = 0.33;
    const test::PoseWorld world = test::makePoseWorld(options);
    const Estimate estimate = estimator.search(world);
    EXPECT_LT(test::rotationErrorRad(estimate.camera_from_map, world.camera_from_map), 0.5 * kPi / 180) << seed;
    EXPECT_LT(test::translationErrorM(estimate.camera_from_map, world.camera_from_map), 0.015) << seed;
  }
}

void expectSameBytes(const Estimate &a, const Estimate &b) {
  EXPECT_EQ(a.camera_from_map.rotation, b.camera_from_map.rotation);
  EXPECT_EQ(a.camera_from_map.translation_m, b.camera_from_map.translation_m);
  EXPECT_EQ(a.covariance, b.covariance);
  EXPECT_EQ(a.depth.mean, b.depth.mean);
  EXPECT_EQ(a.noise_ratio, b.noise_ratio);
  EXPECT_EQ(a.gain, b.gain);
  EXPECT_EQ(a.inliers, b.inliers);
  EXPECT_EQ(a.iterations, b.iterations);
}

PoseQuery queryWithBias(uint64_t seed) {
  PoseQuery query;
  query.seed = seed;
  query.depth.mid_m = 2;
  query.depth.covariance.diagonal() << 1e-4, 1e-4;
  return query;
}

TEST(Estimator, SameSeedSameBytes) {
  test::SensorWorldOptions options = sensorAt(0.3, 1);
  options.depthless_share = 0.2;
  const test::PoseWorld world = test::makeSensorWorld(options);
  test::TestEstimator first, second;
  const Estimate a = first.search(world, queryWithBias(9));
  second.search(world, 3);  // what came before must not matter
  expectSameBytes(a, second.search(world, queryWithBias(9)));
}

TEST(Estimator, TheScalarVersionFindsTheSameBytes) {
  test::TestEstimator ours, scalar(4096, 20000, &scalarPoseKernels());
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    test::SensorWorldOptions options = sensorAt(0.25, seed);
    options.depthless_share = 0.2;
    const test::PoseWorld world = test::makeSensorWorld(options);
    expectSameBytes(ours.search(world, queryWithBias(seed)), scalar.search(world, queryWithBias(seed)));
  }
}

TEST(Estimator, AnyOrderOfCorrespondencesWillDo) {
  test::TestEstimator estimator;
  for (uint64_t seed = 1; seed <= 30; ++seed) {
    test::PoseWorld world = test::makeSensorWorld(sensorAt(0.33, seed));
    const Estimate one = estimator.search(world, seed);
    std::reverse(world.correspondences.begin(), world.correspondences.end());
    const Estimate other = estimator.search(world, seed);
    EXPECT_TRUE(isFound(one, world));
    EXPECT_TRUE(isFound(other, world));
    const double sigma = std::sqrt(one.covariance.trace());  // of the errors together
    EXPECT_LT(test::poseError(one.camera_from_map, other.camera_from_map).norm(), 0.5 * sigma) << seed;
  }
}

// All true ones first, so that any first part of the rows is no fair sample.
TEST(Estimator, SortedCorrespondencesAreFound) {
  test::TestEstimator estimator;
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    test::PoseWorldOptions options;
    options.seed = seed;
    options.true_share = 0.2;
    test::PoseWorld world = test::makePoseWorld(options);  // comes so
    EXPECT_TRUE(isFound(estimator.search(world, seed), world));
    std::reverse(world.correspondences.begin(), world.correspondences.end());
    EXPECT_TRUE(isFound(estimator.search(world, seed), world));
  }
}

struct Effort {
  double iterations = 0;
  int found = 0;
};
Effort effortAt(double eta, bool informative, int worlds) {
  test::TestEstimator estimator;
  Effort effort;
  for (int seed = 1; seed <= worlds; ++seed) {
    test::SensorWorldOptions options = sensorAt(eta, static_cast<uint64_t>(seed));
    options.informative_quality = informative;
    const test::PoseWorld world = test::makeSensorWorld(options);
    const Estimate estimate = estimator.search(world, static_cast<uint64_t>(seed));
    effort.iterations += static_cast<double>(estimate.iterations) / worlds;
    effort.found += isFound(estimate, world);
  }
  return effort;
}

TEST(Estimator, QualityOfMatchesSavesIterations) {
  const Effort plain = effortAt(0.15, false, 200), ordered = effortAt(0.15, true, 200);
  RecordProperty("iterations_plain", std::to_string(plain.iterations));
  RecordProperty("iterations_ordered", std::to_string(ordered.iterations));
  EXPECT_LT(ordered.iterations, 0.8 * plain.iterations);
  EXPECT_GE(ordered.found, plain.found - 1);
}

TEST(Estimator, FewCorrespondences) {
  test::TestEstimator estimator;
  for (size_t count : {0u, 1u, 2u, 3u}) {
    test::PoseWorld world = test::makePoseWorld({});
    world.correspondences.resize(count);
    const Estimate estimate = estimator.search(world);
    EXPECT_EQ(estimate.ending, PoseEnding::kFewCorrespondences);
    EXPECT_EQ(estimate.inliers, 0u);
    EXPECT_EQ(estimate.iterations, 0u);
  }
}

TEST(Estimator, BearingsAloneAreTooFew) {
  test::TestEstimator estimator;
  test::SensorWorldOptions options;
  options.depthless_share = 1;
  EXPECT_EQ(estimator.search(test::makeSensorWorld(options)).ending, PoseEnding::kFewCorrespondences);
}

TEST(Estimator, OneCorrespondenceManyTimesIsHarmless) {
  test::TestEstimator estimator(100, 500);
  test::PoseWorld world = test::makePoseWorld({});
  world.correspondences.assign(100, world.correspondences[0]);
  const Estimate estimate = estimator.search(world);
  EXPECT_LE(estimate.iterations, 512u);
  EXPECT_TRUE(estimate.ending != PoseEnding::kFound || isFinite(estimate.camera_from_map.rotation.sum()));
  EXPECT_NE(estimator.judge(world, estimate), Outcome::kLocalized);
}

TEST(Estimator, IterationsAreBoundedToABatch) {
  for (uint32_t bound : {1u, 16u, 137u, 1000u}) {
    test::TestEstimator estimator(300, bound);
    test::PoseWorldOptions options;
    options.true_share = 0;
    const uint32_t batches = (bound + kMinimalBatch - 1) / kMinimalBatch;
    const Estimate estimate = estimator.search(test::makePoseWorld(options));
    EXPECT_LE(estimate.iterations, batches * kMinimalBatch);
  }
}

TEST(Estimator, AQueryMayAskForFewerSamples) {
  test::TestEstimator estimator(300, 1000);
  test::PoseWorldOptions options;
  options.true_share = 0;
  const test::PoseWorld world = test::makePoseWorld(options);
  PoseQuery query;
  for (const uint32_t most : {1u, 40u, 137u}) {
    query.most_samples = most;
    EXPECT_EQ(estimator.search(world, query).iterations, most);
  }
}

TEST(Estimator, NoiseAloneIsNotLocalized) {
  test::TestEstimator estimator(400, 3000);
  for (uint64_t seed = 1; seed <= 100; ++seed) {
    const test::PoseWorld world = test::makeSensorWorld(sensorAt(0, seed));
    const Estimate estimate = estimator.search(world, seed);
    EXPECT_NE(estimator.judge(world, estimate), Outcome::kLocalized) << estimate.inliers;
  }
}

TEST(Estimator, ADeadlineThatHasPassedGivesNothing) {
  test::TestEstimator estimator;
  const test::PoseWorld world = test::makeSensorWorld(sensorAt(0.33, 1));
  test::SteppingClock clock(1000);
  PoseQuery query;
  query.deadline = clock.deadline(0);
  const Estimate estimate = estimator.search(world, query);
  EXPECT_EQ(estimate.ending, PoseEnding::kDeadline);
  EXPECT_TRUE(estimate.cut_short);
  EXPECT_EQ(estimate.iterations, 0u);
}

TEST(Estimator, ADeadlineGivesTheBestSoFar) {
  constexpr uint32_t kLooks = 40;
  test::TestEstimator estimator;
  int found = 0, cut = 0;
  for (uint64_t seed = 1; seed <= 50; ++seed) {
    const test::PoseWorld world = test::makeSensorWorld(sensorAt(0.15, seed));
    test::SteppingClock clock(1000);
    PoseQuery query;
    query.seed = seed;
    query.deadline = clock.deadline(kLooks * 1000);
    const Estimate estimate = estimator.search(world, query);
    EXPECT_LE(estimate.iterations, kLooks * kMinimalBatch);
    EXPECT_TRUE(estimate.ending == PoseEnding::kFound || estimate.ending == PoseEnding::kDeadline);
    cut += estimate.cut_short;
    found += isFound(estimate, world);
  }
  RecordProperty("cut_short_of_50", cut);
  RecordProperty("right_of_50", found);
  EXPECT_GT(cut, 25);
  EXPECT_GT(found, 5) << "right before its time";
  EXPECT_LT(found, 50);
}

TEST(Estimator, ALateDeadlineChangesNothing) {
  test::TestEstimator estimator;
  const test::PoseWorld world = test::makeSensorWorld(sensorAt(0.33, 2));
  test::SteppingClock clock(1000);
  PoseQuery query, with;
  with.deadline = clock.deadline(int64_t{1} << 60);
  expectSameBytes(estimator.search(world, query), estimator.search(world, with));
}

TEST(Estimator, InliersAreThoseOfItsOwnCount) {
  test::TestEstimator estimator;
  test::SensorWorldOptions options = sensorAt(0.33, 4);
  options.bias = {0.01, 0.02};
  const test::PoseWorld world = test::makeSensorWorld(options);
  for (const Vector2 &known : {options.bias, Vector2(0, 0)}) {
    PoseQuery query = queryWithBias(1);
    query.depth.mean = known;
    const Estimate estimate = estimator.search(world, query);
    uint32_t agreeing = 0;
    for (const Correspondence &c : world.correspondences) agreeing += estimator.get().isInlier(c, estimate);
    EXPECT_NEAR(agreeing, estimate.inliers, 1) << known.transpose();
    EXPECT_GT(agreeing, 70u);
  }
}

}  // namespace
}  // namespace sphc
