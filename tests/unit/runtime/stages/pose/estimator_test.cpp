#include "runtime/stages/pose/estimator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "tests/support/pose_world.h"
#include "tests/support/random_numbers.h"
#include "tests/unit/runtime/stages/pose/pose_test_estimator.h"

namespace sphc {
namespace {

void expectExactAt(double eta, uint32_t worlds) {
  test::TestEstimator estimator;
  for (uint64_t seed = 1; seed <= worlds; ++seed) {
    test::PoseWorldOptions options;
    options.seed = seed;
    options.true_share = eta;
    const test::PoseWorld world = test::makePoseWorld(options);
    const Estimate estimate = estimator.search(world, seed);
    EXPECT_LT(test::rotationErrorRad(estimate.camera_from_map, world.camera_from_map), 1e-3) << seed;
    EXPECT_LT(test::translationErrorM(estimate.camera_from_map, world.camera_from_map), 2e-3) << seed;
    EXPECT_GE(estimate.inliers, static_cast<uint32_t>(eta * 300) - 1) << seed;
    EXPECT_LE(estimate.inliers, static_cast<uint32_t>(eta * 300) + 25) << seed;
  }
}

TEST(Estimator, FindsTheExactPoseAtEta100) { expectExactAt(1, 20); }
TEST(Estimator, FindsTheExactPoseAtEta33) { expectExactAt(0.33, 20); }
TEST(Estimator, FindsTheExactPoseAtEta25) { expectExactAt(0.25, 20); }

TEST(Estimator, WithNoiseTheErrorIsThatOfTheNoise) {
  test::TestEstimator estimator;
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    test::PoseWorldOptions options;
    options.seed = seed;
    options.true_share = 0.33;
    options.depth_sigma_m = options.stated_depth_sigma_m = 0.015;
    options.pixel_sigma_px = 0.8;
    const test::PoseWorld world = test::makePoseWorld(options);
    const Estimate estimate = estimator.search(world);
    EXPECT_LT(test::rotationErrorRad(estimate.camera_from_map, world.camera_from_map), 0.5 * kPi / 180) << seed;
    EXPECT_LT(test::translationErrorM(estimate.camera_from_map, world.camera_from_map), 0.015) << seed;
  }
}

// The covariance is in the camera frame for a perturbation on the left: the normalised squared error of many worlds
// averages to the six degrees of freedom.
TEST(Estimator, CovarianceTellsTheErrorThatIsMade) {
  test::TestEstimator estimator;
  double sum = 0;
  constexpr int kWorlds = 60;
  for (uint64_t seed = 1; seed <= kWorlds; ++seed) {
    test::PoseWorldOptions options;
    options.seed = seed;
    options.depth_sigma_m = options.stated_depth_sigma_m = 0.01;
    options.pixel_sigma_px = 0;
    const test::PoseWorld clean = test::makePoseWorld(options);
    test::PoseWorld world = clean;
    Random random(seed + 1000);
    for (Correspondence &c : world.correspondences)  // across as stated, too
      c.lifted.point_m += c.lifted.sideways_m * Vector3(test::normal(&random), test::normal(&random), 0);
    const Estimate estimate = estimator.search(world);
    const Rigid error = world.camera_from_map * estimate.camera_from_map.inverse();  // T_true = exp(xi) T_estimate
    Vector6 xi;
    const Eigen::AngleAxisd turn(error.rotation);
    xi << turn.angle() * turn.axis(), error.translation_m;
    sum += xi.dot(estimate.covariance.inverse() * xi);
  }
  EXPECT_GT(sum / kWorlds, 3);
  EXPECT_LT(sum / kWorlds, 12);
}

TEST(Estimator, SameSeedSameBytes) {
  test::PoseWorldOptions options;
  options.true_share = 0.3;
  options.depth_sigma_m = 0.01;
  const test::PoseWorld world = test::makePoseWorld(options);
  test::TestEstimator first, second;
  const Estimate a = first.search(world, 9);
  second.search(world, 3);  // what came before must not matter
  const Estimate b = second.search(world, 9);
  EXPECT_EQ(a.camera_from_map.rotation, b.camera_from_map.rotation);
  EXPECT_EQ(a.camera_from_map.translation_m, b.camera_from_map.translation_m);
  EXPECT_EQ(a.covariance, b.covariance);
  EXPECT_EQ(a.iterations, b.iterations);
}

TEST(Estimator, TooFewCorrespondences) {
  test::TestEstimator estimator;
  for (size_t count : {0u, 1u, 2u, 3u}) {
    test::PoseWorld world = test::makePoseWorld({});
    world.correspondences.resize(count);
    EXPECT_EQ(estimator.search(world).inliers, 0u);
  }
}

TEST(Estimator, OneCorrespondenceManyTimesIsHarmless) {
  test::TestEstimator estimator(100, 500);
  test::PoseWorld world = test::makePoseWorld({});
  world.correspondences.assign(100, world.correspondences[0]);
  const Estimate estimate = estimator.search(world);
  EXPECT_LE(estimate.iterations, 500u);
}

TEST(Estimator, IterationsAreBounded) {
  test::TestEstimator estimator(300, 137);
  test::PoseWorldOptions options;
  options.true_share = 0;
  EXPECT_LE(estimator.search(test::makePoseWorld(options)).iterations, 137u);
}

}  // namespace
}  // namespace sphc
