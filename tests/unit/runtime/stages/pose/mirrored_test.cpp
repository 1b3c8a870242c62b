#include "runtime/stages/pose/mirrored.h"

#include <gtest/gtest.h>

#include "tests/support/pose_world.h"
#include "tests/support/random_numbers.h"
#include "tests/unit/runtime/stages/pose/pose_test_estimator.h"

namespace sphc {
namespace {

struct FlatOptions {
  double radius_m = 0.15;  // of a patch 4 m from the sphere centre
  double tilt_rad = 0.6;   // of its normal from the line of sight
  double relief_m = 0;     // of its points off the plane
  double true_share = 1;
};

// A flat patch before a camera; the sphere centre is the map's origin.
test::PoseWorld flatWorld(uint64_t seed, const FlatOptions &options) {
  Random random(seed);
  test::PoseWorld world;
  const Vector3 centre_m(0, 0, 4);
  const Matrix3 tilted = rotationFromVector(Vector3(options.tilt_rad, 0, 0));
  const Rigid map_from_camera = {rotationFromVector(0.3 * test::normalVector(&random)), Vector3(1, 0.2, 2)};
  world.camera_from_map = map_from_camera.inverse();
  for (int i = 0; i < 200; ++i) {
    const double x = options.radius_m * (2 * random.uniform() - 1),
                 y = options.radius_m * (2 * random.uniform() - 1);
    const Vector3 point_m = centre_m + tilted * Vector3(x, y, options.relief_m * (2 * random.uniform() - 1));
    const bool is_true = random.uniform() < options.true_share;
    const Vector3 direction = is_true ? point_m.normalized() : test::randomDirection(&random);
    world.correspondences.push_back({{world.camera_from_map * point_m, 0.004, 0.008}, direction});
    world.is_true.push_back(is_true);
  }
  return world;
}

bool mirror(const test::PoseWorld &world, const Rigid &pose, Rigid *mirrored) {
  return mirroredPose({world.correspondences.data(), world.correspondences.size()}, pose, 30, mirrored);
}

TEST(MirroredPose, TiltsThePlaneTheOtherWay) {
  const test::PoseWorld world = flatWorld(1, {});
  Rigid other, back;
  ASSERT_TRUE(mirror(world, world.camera_from_map, &other));
  EXPECT_NEAR(test::rotationErrorRad(other, world.camera_from_map), 2 * 0.6, 0.02);
  // and twice is where we were
  ASSERT_TRUE(mirror(world, other, &back));
  EXPECT_LT(test::rotationErrorRad(back, world.camera_from_map), 0.01);
  EXPECT_LT(test::translationErrorM(back, world.camera_from_map), 0.03);
}

TEST(MirroredPose, NoneOfASceneWithDepthOrSeenSquarely) {
  Rigid other;
  const test::PoseWorld deep = flatWorld(2, {0.15, 0.6, 0.15}), square = flatWorld(3, {0.15, 0.02});
  EXPECT_FALSE(mirror(deep, deep.camera_from_map, &other));
  EXPECT_FALSE(mirror(square, square.camera_from_map, &other));
  EXPECT_FALSE(mirroredPose({}, Rigid(), 30, &other));
}

// Most of its inliers are also those of the mirrored pose, so that a search may meet with that first.
TEST(MirroredPose, TheSearchGivesTheRightOneOfTheTwo) {
  test::TestEstimator estimator;
  for (uint64_t seed = 1; seed <= 100; ++seed) {
    const test::PoseWorld world = flatWorld(seed, {0.5, 0.6, 0, 0.33});
    const Estimate estimate = estimator.search(world, seed);
    EXPECT_LT(test::rotationErrorRad(estimate.camera_from_map, world.camera_from_map), 0.02) << seed;
  }
}

// Whoever ends with the wrong one asks for the other, and sees that it is better.
TEST(MirroredPose, RefinedFromTheWrongOneIsTheRightOne) {
  test::TestEstimator estimator;
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    const test::PoseWorld world = flatWorld(seed, {0.5, 0.6, 0, 0.5});
    PoseQuery query;
    query.correspondences = {world.correspondences.data(), world.correspondences.size()};
    Rigid wrong;
    ASSERT_TRUE(mirror(world, world.camera_from_map, &wrong)) << seed;
    const Estimate stayed = estimator.get().refine(query, wrong);
    const Estimate other = estimator.get().refineMirrored(query, stayed.camera_from_map);
    EXPECT_GT(test::rotationErrorRad(stayed.camera_from_map, world.camera_from_map), 0.5) << seed;
    EXPECT_LT(test::rotationErrorRad(other.camera_from_map, world.camera_from_map), 0.02) << seed;
    EXPECT_GT(other.gain, stayed.gain) << seed;
  }
}

TEST(MirroredPose, NothingToRefineInASceneWithDepth) {
  test::TestEstimator estimator;
  const test::PoseWorld world = flatWorld(2, {0.15, 0.6, 0.15});
  PoseQuery query;
  query.correspondences = {world.correspondences.data(), world.correspondences.size()};
  EXPECT_EQ(estimator.get().refineMirrored(query, world.camera_from_map).ending, PoseEnding::kNoConsensus);
}

}  // namespace
}  // namespace sphc
