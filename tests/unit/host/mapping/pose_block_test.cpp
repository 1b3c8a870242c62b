#include "host/mapping/pose_block.h"

#include <gtest/gtest.h>

namespace sphc::host {
namespace {

const Rigid kPose = {rotationFromVector(Vector3(0.4, -1.2, 0.7)), Vector3(1, -2, 3)};

TEST(PoseBlockTest, HoldsAPose) {
  const Rigid back = poseFrom(blockFrom(kPose).data());
  EXPECT_TRUE(back.rotation.isApprox(kPose.rotation, 1e-12));
  EXPECT_TRUE(back.translation_m.isApprox(kPose.translation_m, 1e-12));
}

TEST(PoseBlockTest, StepsAreTakenBack) {
  const PoseManifold manifold;
  const double delta[6] = {0.02, -0.03, 0.01, 0.2, -0.1, 0.05};
  const PoseBlock before = blockFrom(kPose);
  PoseBlock after;
  ASSERT_TRUE(manifold.Plus(before.data(), delta, after.data()));
  const Rigid step = {rotationFromVector(Vector3(0.02, -0.03, 0.01)), Vector3(0.2, -0.1, 0.05)};
  EXPECT_TRUE(poseFrom(after.data()).translation_m.isApprox((step * kPose).translation_m, 1e-12));
  double found[6];
  ASSERT_TRUE(manifold.Minus(after.data(), before.data(), found));
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(found[i], delta[i], 1e-12) << i;
}

TEST(PoseBlockTest, TheTwoJacobiansAreInverse) {
  const PoseManifold manifold;
  Eigen::Matrix<double, 7, 6, Eigen::RowMajor> plus;
  Eigen::Matrix<double, 6, 7, Eigen::RowMajor> minus;
  manifold.PlusJacobian(nullptr, plus.data());
  manifold.MinusJacobian(nullptr, minus.data());
  EXPECT_TRUE((minus * plus).isIdentity());
}

}  // namespace
}  // namespace sphc::host
