#include "host/report/trajectory_score.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/random_numbers.h"

namespace sphc::host {
namespace {

const Rigid kOther = {rotationFromVector(Vector3(0.3, -1, 2)), Vector3(4, 5, -6)};

std::vector<PosePair> pairs(double scale) {
  std::vector<PosePair> poses;
  Random random(1);
  for (int i = 0; i < 20; ++i) {
    const Rigid truth = {test::randomRotation(&random), test::normalVector(&random)};
    Rigid estimated = kOther * truth;
    estimated.translation_m *= scale;
    poses.push_back({estimated, truth});
  }
  return poses;
}

TEST(TrajectoryScoreTest, TheSamePathInAnotherWorldIsExact) {
  const TrajectoryScore score = scoreTrajectory(pairs(1));
  EXPECT_EQ(score.frames, 20u);
  EXPECT_LT(score.rigid_rmse_m, 1e-9);
  EXPECT_LT(score.rotation_worst_deg, 1e-6);
  EXPECT_NEAR(score.scale, 1, 1e-9);
}

TEST(TrajectoryScoreTest, ScaleIsToldApart) {
  const TrajectoryScore score = scoreTrajectory(pairs(1.02));
  EXPECT_NEAR(score.scale, 1.02, 1e-9);
  EXPECT_LT(score.similarity_rmse_m, 1e-9);
  EXPECT_GT(score.rigid_rmse_m, 0.005);
}

TEST(TrajectoryScoreTest, ErrorsAreMeasured) {
  std::vector<PosePair> poses = pairs(1);
  poses[7].estimated.rotation *= rotationFromVector(Vector3(0.01, 0, 0));
  const TrajectoryScore score = scoreTrajectory(poses);
  EXPECT_NEAR(score.rotation_worst_deg, 0.573, 0.001);
  EXPECT_LT(score.rotation_median_deg, 1e-6);
}

TEST(TrajectoryScoreTest, OnePlaceThatIsOffIsTheWorst) {
  const std::vector<PosePair> once = pairs(1);
  std::vector<PosePair> poses;
  for (int i = 0; i < 10; ++i) poses.insert(poses.end(), once.begin(), once.end());
  poses[7].estimated.translation_m += Vector3(0.3, 0, 0);
  const TrajectoryScore score = scoreTrajectory(poses);
  EXPECT_NEAR(score.rigid_worst_m, 0.3, 0.01);
  EXPECT_LT(score.rigid_rmse_m, 0.03);
}

// Two laps, the second drawn 4 cm higher than it is.
TEST(TrajectoryScoreTest, ALoopThatDoesNotCloseIsMeasuredWhereThePathComesBack) {
  constexpr int kFrames = 100;
  std::vector<PosePair> poses;
  for (int i = 0; i < 2 * kFrames; ++i) {
    const double angle = 2 * kPi * i / kFrames;
    Rigid truth;
    truth.translation_m = Vector3(2 * std::cos(angle), 2 * std::sin(angle), 0);
    Rigid estimated = truth;
    if (i >= kFrames) estimated.translation_m.z() += 0.04;
    poses.push_back({estimated, truth});
  }
  const TrajectoryScore score = scoreTrajectory(poses);
  ASSERT_TRUE(score.revisit_worst_m);
  EXPECT_NEAR(*score.revisit_worst_m, 0.04, 0.001);
  EXPECT_LT(score.rigid_worst_m, 0.03) << "the alignment halves it";
  poses.resize(kFrames / 2);
  EXPECT_FALSE(scoreTrajectory(poses).revisit_worst_m) << "it does not come back";
}

TEST(TrajectoryScoreTest, ATruthThatIsInverseIsNoticed) {
  std::vector<PosePair> poses = pairs(1);
  EXPECT_FALSE(isTruthInverse(poses));
  for (PosePair &pose : poses) pose.truth = pose.truth.inverse();
  EXPECT_TRUE(isTruthInverse(poses));
  Random random(2);
  for (PosePair &pose : poses) pose.truth.translation_m = test::normalVector(&random);
  EXPECT_FALSE(isTruthInverse(poses)) << "it is of another walk";
}

TEST(TrajectoryScoreTest, TwoPosesAreTooFew) {
  std::vector<PosePair> poses = pairs(1);
  poses.resize(2);
  EXPECT_THROW(scoreTrajectory(poses), std::runtime_error);
}

}  // namespace
}  // namespace sphc::host
