// Scores and residuals of rows, against residual.h in double precision.
#include <gtest/gtest.h>

#include "runtime/stages/pose/residual.h"
#include "tests/support/pose_rows.h"
#include "tests/support/random_numbers.h"

namespace sphc {
namespace {

constexpr double kThreshold2 = 12;
constexpr ScoreLimits kToTheEnd = {1 / 12.0f, -1, 0, 0};

double slowGain(const test::PoseWorld &world, const Rigid &pose) {
  double sum = 0;
  for (const Correspondence &c : world.correspondences) {
    const Residual r = residualOf(c, pose);
    if (r.in_front && r.squared < kThreshold2) sum += 1 - r.squared / kThreshold2;
  }
  return sum;
}

test::PoseWorld scoredWorld(size_t count, double true_share = 0.5) {
  test::PoseWorldOptions options;
  options.count = count;
  options.true_share = true_share;
  options.depth_sigma_m = 0.01;
  options.pixel_sigma_px = 0.8;
  return test::makePoseWorld(options);
}

TEST(Score, IsTheSumOfWhatRowsGain) {
  Random random(1);
  for (size_t count : {1u, 15u, 16u, 63u, 64u, 65u, 300u}) {
    const test::PoseWorld world = scoredWorld(count);
    const test::OwnedRows owned(world.correspondences, simdPoseKernels());
    for (int i = 0; i < 50; ++i) {
      const Rigid pose =
          i == 0 ? world.camera_from_map : Rigid{test::randomRotation(&random), test::normalVector(&random)};
      const Score score = simdPoseKernels().score(owned.rows, poseF(pose), kToTheEnd);
      const double expected = slowGain(world, pose);
      EXPECT_NEAR(static_cast<double>(score.gain), expected, 1e-3 * expected + 1e-3);
      EXPECT_EQ(score.seen, static_cast<float>(count));
    }
  }
}

TEST(Score, GivesUpWhatCannotBeBest) {
  const test::PoseWorld world = scoredWorld(300, 0);
  const test::OwnedRows owned(world.correspondences, simdPoseKernels());
  const Score score = simdPoseKernels().score(owned.rows, poseF(world.camera_from_map), {1 / 12.0f, 200, 0, 0});
  EXPECT_EQ(score.seen, 128) << "44 are left after 256, but 172 after 128";
  EXPECT_LT(score.gain, 28);
}

TEST(Score, GivesUpByTheSlope) {
  const test::PoseWorld world = scoredWorld(300, 0);
  const test::OwnedRows owned(world.correspondences, simdPoseKernels());
  const PoseF pose = poseF(world.camera_from_map);
  EXPECT_EQ(simdPoseKernels().score(owned.rows, pose, {1 / 12.0f, -1, 0.5f, 2}).seen, 64);
  EXPECT_EQ(simdPoseKernels().score(owned.rows, pose, {1 / 12.0f, -1, 0.5f, 90}).seen, 192);
  EXPECT_EQ(simdPoseKernels().score(owned.rows, pose, {1 / 12.0f, -1, 0.5f, 150}).seen, 300);
}

TEST(Score, TheTruthScoresBest) {
  Random random(2);
  const test::PoseWorld world = scoredWorld(300, 0.33);
  const test::OwnedRows owned(world.correspondences, simdPoseKernels());
  const float truth = simdPoseKernels().score(owned.rows, poseF(world.camera_from_map), kToTheEnd).gain;
  for (int i = 0; i < 2000; ++i) {
    const Rigid other = {test::randomRotation(&random), 2 * test::normalVector(&random)};
    EXPECT_GT(truth, simdPoseKernels().score(owned.rows, poseF(other), kToTheEnd).gain);
  }
}

}  // namespace
}  // namespace sphc
