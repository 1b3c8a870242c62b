// What rows are made of.
#include "runtime/stages/pose/rows.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/pose_rows.h"
#include "tests/support/sensor_world.h"

namespace sphc {
namespace {

test::PoseWorld mixedWorld() {
  test::SensorWorldOptions options;
  options.count = 100;
  options.depthless_share = 0.3;
  return test::makeSensorWorld(options);
}

TEST(Rows, PreparedRowsHoldViewWeightAndStretch) {
  const test::PoseWorld world = mixedWorld();
  const test::OwnedRows owned(world.correspondences, simdPoseKernels());
  const PoseRows &rows = owned.rows;
  ASSERT_EQ(rows.count, 100u);
  ASSERT_EQ(rows.padded, 128u);
  for (uint32_t i = 0; i < rows.count; ++i) {
    const LiftedPoint &lifted = world.correspondences[i].lifted;
    EXPECT_LT((rows.view(i) - lifted.point_m.normalized()).norm(), 1e-6);
    EXPECT_LT((rows.direction(i) - world.correspondences[i].direction).norm(), 1e-6);
    const double weight = 1 / (lifted.sideways_m * lifted.sideways_m), ratio = lifted.sideways_m / lifted.along_m;
    EXPECT_NEAR(static_cast<double>(rows.field[kWeight][i]) / weight, 1, 1e-5);
    EXPECT_NEAR(static_cast<double>(rows.field[kStretch][i]), ratio * ratio - 1, 1e-5);
  }
}

TEST(Rows, DepthsAreCorrectedAndBearingsAreNot) {
  const test::PoseWorld world = mixedWorld();
  test::OwnedRows owned(world.correspondences);
  const DepthCorrection correction = {0.05f, -0.02f, 1.5f, 2.0f};
  simdPoseKernels().prepare(&owned.rows, correction);
  for (uint32_t i = 0; i < owned.rows.count; ++i) {
    const LiftedPoint &lifted = world.correspondences[i].lifted;
    const double z = lifted.point_m.z(), bias = lifted.hasDepth() ? 0.05 - 0.02 * (z - 1.5) : 0;
    EXPECT_NEAR(static_cast<double>(owned.rows.field[kPointZ][i]), z + bias, 1e-5);
    EXPECT_LT((owned.rows.view(i) - lifted.point_m.normalized()).norm(), 1e-6);
    const double ratio = lifted.sideways_m / (2 * lifted.along_m);
    EXPECT_NEAR(static_cast<double>(owned.rows.field[kStretch][i]), ratio * ratio - 1, 1e-5);
  }
}

TEST(Rows, PaddingGainsNothing) {
  const test::PoseWorld world = mixedWorld();
  const test::OwnedRows owned(world.correspondences, simdPoseKernels());
  NormalTask task = {};
  task.pose = poseF(world.camera_from_map);
  std::vector<float> squared(owned.rows.padded), plane(owned.rows.padded);
  simdPoseKernels().residuals(owned.rows, task, squared.data());
  simdPoseKernels().plane_residuals(owned.rows, task, plane.data());
  for (uint32_t i = owned.rows.count; i < owned.rows.padded; ++i) {
    EXPECT_EQ(squared[i], kNeverNear);
    EXPECT_EQ(plane[i], kNeverNear);
  }
}

TEST(Rows, PushBelowKeepsWhatIsBelowInOrder) {
  const test::PoseWorld world = mixedWorld();
  const test::OwnedRows from(world.correspondences, simdPoseKernels());
  test::OwnedRows to(200);
  std::vector<float> value(100);
  std::vector<uint32_t> index(100), expected;
  for (uint32_t i = 0; i < 100; ++i) {
    value[i] = static_cast<float>(i * 37 % 100);
    if (i == 50) value[i] = std::numeric_limits<float>::quiet_NaN();
    if (value[i] < 40.0f) expected.push_back(i);
  }
  for (uint32_t times = 1; times <= 2; ++times) to.rows.pushBelow(from.rows, value.data(), 40, index.data());
  ASSERT_EQ(to.rows.count, 2 * expected.size());
  for (uint32_t f = 0; f < to.rows.fieldCount(); ++f)
    for (uint32_t i = 0; i < to.rows.count; ++i)
      EXPECT_EQ(to.rows.field[f][i], from.rows.field[f][expected[i % expected.size()]]);
}

}  // namespace
}  // namespace sphc
