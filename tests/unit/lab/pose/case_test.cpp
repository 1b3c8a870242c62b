#include "lab/pose/case.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pose_bytes.h"

namespace sphc::host {
namespace {

PoseFile goodFile() { return parsePoseFile(test::goodPoseFile().span(), "FILE"); }

TEST(PoseCase, LiftsByPixelAndDepthWithTheirErrors) {
  CaseNoise noise;
  noise.pixel_sigma_px = 1;
  noise.depth_sigma_m = 0.01;
  noise.depth_sigma_per_m2 = 0.005;
  noise.map_sigma_m = 0;
  const PoseFile file = goodFile();
  const LiftedPoint lifted = liftPixel(file.queries[0].camera, {320 + 375, 240}, 2, noise);
  EXPECT_LT((lifted.point_m - Vector3(1.5, 0, 2)).norm(), 1e-12);
  EXPECT_NEAR(lifted.sideways_m, 2.0 / 500, 1e-12);
  EXPECT_NEAR(lifted.along_m, 0.03 * 1.25, 1e-12);  // along the view, not along z
}

TEST(PoseCase, RowsWithoutDepthStandApart) {
  const PoseFile file = goodFile();
  const PoseCase c = makePoseCase(file.queries[0], 33, DepthSource::kTof, {}, nullptr);
  EXPECT_EQ(c.correspondences.size(), 2u);
  EXPECT_EQ(c.is_true, (std::vector<bool>{false, false}));
  ASSERT_EQ(c.without_depth.size(), 1u);
  EXPECT_TRUE(c.without_depth_is_true.at(0));
  EXPECT_EQ(c.without_depth[0].lifted.point_m.z(), 1);
  EXPECT_TRUE(std::isinf(c.without_depth[0].lifted.along_m));
  EXPECT_EQ(makePoseCase(file.queries[0], 33, DepthSource::kOracle, {}, nullptr).correspondences.size(), 3u);
}

TEST(PoseCase, DepthCountsWithinItsBounds) {
  const PinholeCamera camera = goodFile().queries[0].camera;
  const auto known = [&camera](double z) { return std::isfinite(liftPixel(camera, {0, 0}, z, {}).along_m); };
  EXPECT_FALSE(known(0));
  EXPECT_FALSE(known(0.01));
  EXPECT_TRUE(known(0.011));
  EXPECT_TRUE(known(5));
  EXPECT_FALSE(known(5.001));
}

TEST(PoseCase, TruePointsAreThoseOfRowsWithDepthFoundByNameAndIndex) {
  const PoseFile file = goodFile();
  PoseFile eta100 = file;
  std::swap(eta100.queries[0], eta100.queries[1]);
  eta100.queries[1].points_map_m = {{1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  auto cases = makePoseCases(file, DepthSource::kTof, {}, eta100);
  ASSERT_EQ(cases.size(), 2u);
  ASSERT_EQ(cases[0].true_points_map_m.size(), 2u);
  EXPECT_EQ(cases[0].true_points_map_m[1], Vector3(3, 0, 0));
  EXPECT_EQ(cases[0].true_pixels_px[1], Vector2(420, 240));
  eta100.queries[1].index = 1;
  EXPECT_TRUE(makePoseCases(file, DepthSource::kTof, {}, eta100)[0].true_points_map_m.empty());
}

}  // namespace
}  // namespace sphc::host
