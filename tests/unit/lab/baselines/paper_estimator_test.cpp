#include "lab/baselines/paper_estimator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "runtime/base/random.h"
#include "tests/support/pose_world.h"
#include "tests/support/random_numbers.h"

namespace sphc::host {
namespace {

PaperCostConfig configOf(double focal_px = 525) {
  PaperCostConfig config;
  config.focal_px = focal_px;
  return config;
}

Span<const Correspondence> rowsOf(const test::PoseWorld &world) {
  return {world.correspondences.data(), world.correspondences.size()};
}

// Equation 1 with the essential matrix written out, and the 2x2 system of the supplement solved in general.
TEST(PaperEstimator, ResidualIsThatOfTheEquations) {
  test::PoseWorldOptions options;
  options.true_share = 0.5;
  const test::PoseWorld world = test::makePoseWorld(options);
  const Rigid &pose = world.camera_from_map;
  const Matrix3 essential = crossMatrix(pose.translation_m) * pose.rotation;
  for (const Correspondence &c : world.correspondences) {
    const PaperResidual r = paperResidualOf(c, pose);
    const Vector3 x = c.lifted.point_m / c.lifted.point_m.z();
    const Vector3 tilde = c.direction / std::abs(c.direction.z());
    const double above = x.dot(essential * tilde);
    const double below = std::pow(essential.row(0).dot(tilde), 2) + std::pow(essential.row(1).dot(tilde), 2);
    EXPECT_NEAR(r.epipolar2, above * above / below, 1e-12 + 1e-9 * r.epipolar2);
    const Vector3 ray = pose.rotation * c.direction;
    Eigen::Matrix2d system;
    system << c.lifted.point_m.x(), -ray.x(), c.lifted.point_m.z(), -ray.z();
    const Eigen::Vector2d solved =
        system.fullPivLu().solve(Eigen::Vector2d(pose.translation_m.x(), pose.translation_m.z()));
    EXPECT_NEAR(r.beta, solved[0], 1e-9 * (1 + std::abs(solved[0])));
    EXPECT_EQ(r.in_front, solved[0] > 0 && solved[1] > 0);
  }
}

TEST(PaperEstimator, ExactInputGivesTheExactPose) {
  for (const double eta : {1.0, 0.33, 0.25}) {
    for (uint64_t seed = 1; seed <= 10; ++seed) {
      test::PoseWorldOptions options;
      options.seed = seed;
      options.true_share = eta;
      const test::PoseWorld world = test::makePoseWorld(options);
      const Estimate estimate = estimateWithPaperCost(configOf(), rowsOf(world), seed);
      EXPECT_LT(test::rotationErrorRad(estimate.camera_from_map, world.camera_from_map), 2e-3)
          << eta << " " << seed;
      EXPECT_LT(test::translationErrorM(estimate.camera_from_map, world.camera_from_map), 5e-3)
          << eta << " " << seed;
      EXPECT_GE(estimate.iterations, 10u);
    }
  }
}

TEST(PaperEstimator, RefinementReachesTheMinimumFromNearby) {
  const test::PoseWorld world = test::makePoseWorld({});
  Rigid start = world.camera_from_map;
  start.rotation = rotationFromVector({5e-4, -5e-4, 5e-4}) * start.rotation;
  start.translation_m += Vector3(1e-3, -1e-3, 2e-3);
  const Rigid refined = refineWithPaperCost(configOf(), rowsOf(world), start, 50);
  EXPECT_LT(test::rotationErrorRad(refined, world.camera_from_map), 1e-7);
  EXPECT_LT(test::translationErrorM(refined, world.camera_from_map), 1e-7);
}

// The step that the derivatives ask for is downhill for a numeric derivative, too: at the minimum of noisy input no
// small move lowers the sum.
TEST(PaperEstimator, NoSmallMoveIsBetterThanTheRefinedPose) {
  test::PoseWorldOptions options;
  options.depth_sigma_m = 0.01;
  options.pixel_sigma_px = 0.3;
  const test::PoseWorld world = test::makePoseWorld(options);
  PaperCostConfig config = configOf();
  config.epipolar_gate_px = 50;  // nothing is cut off, so that the sum is smooth
  config.depth_gate = 2;
  const Rigid refined = refineWithPaperCost(config, rowsOf(world), world.camera_from_map, 100);
  const double least = paperScoreOf(config, rowsOf(world), refined).msac;
  for (int k = 0; k < 6; ++k) {
    for (const double step : {-1e-4, 1e-4}) {
      Rigid moved = refined;
      if (k < 3)
        moved.rotation = rotationFromVector(step * Vector3::Unit(k)) * moved.rotation;
      else
        moved.translation_m += step * Vector3::Unit(k - 3);
      EXPECT_GT(paperScoreOf(config, rowsOf(world), moved).msac, least) << k << " " << step;
    }
  }
}

TEST(PaperEstimator, DirectionsOfTheWrongSignAreNoInliers) {
  test::PoseWorld world = test::makePoseWorld({});
  for (size_t i = 0; i < world.correspondences.size(); i += 3)
    world.correspondences[i].direction = -world.correspondences[i].direction;
  EXPECT_EQ(paperScoreOf(configOf(), rowsOf(world), world.camera_from_map).inliers, 200u);
}

TEST(PaperEstimator, TooFewRowsGiveNoAnswer) {
  const test::PoseWorld world = test::makePoseWorld({});
  for (size_t count = 0; count < 4; ++count)
    EXPECT_EQ(estimateWithPaperCost(configOf(), rowsOf(world).first(count), 1).inliers, 0u);
}

TEST(PaperEstimator, RowsThatAreAllTheSameEndWithinTheBound) {
  test::PoseWorld world = test::makePoseWorld({});
  for (Correspondence &c : world.correspondences) c = world.correspondences[0];
  PaperCostConfig config = configOf();
  config.max_iterations = 200;
  EXPECT_LE(estimateWithPaperCost(config, rowsOf(world), 1).iterations, 200u);
}

TEST(PaperEstimator, SameSeedSameBytes) {
  test::PoseWorldOptions options;
  options.true_share = 0.3;
  options.depth_sigma_m = 0.01;
  const test::PoseWorld world = test::makePoseWorld(options);
  const Estimate a = estimateWithPaperCost(configOf(), rowsOf(world), 7);
  const Estimate b = estimateWithPaperCost(configOf(), rowsOf(world), 7);
  EXPECT_EQ(std::memcmp(a.camera_from_map.rotation.data(), b.camera_from_map.rotation.data(), 9 * sizeof(double)),
            0);
  EXPECT_EQ(a.iterations, b.iterations);
}

}  // namespace
}  // namespace sphc::host
