#include "runtime/stages/pose/refine.h"

#include <gtest/gtest.h>

#include "runtime/stages/pose/residual.h"
#include "tests/support/pose_world.h"
#include "tests/support/random_numbers.h"

namespace sphc {
namespace {

constexpr double kScale2 = 4;

Span<const Correspondence> spanOf(const test::PoseWorld &world) {
  return {world.correspondences.data(), world.correspondences.size()};
}

Rigid disturbed(const Rigid &pose, double rotation_rad, double translation_m, Random *random) {
  const Vector3 axis = test::randomDirection(random), shift = test::randomDirection(random);
  const Matrix3 turn = rotationFromVector(rotation_rad * axis);
  return {turn * pose.rotation, turn * pose.translation_m + translation_m * shift};
}

TEST(Refine, ConvergesToTheExactPose) {
  Random random(1);
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    test::PoseWorldOptions options;
    options.seed = seed;
    options.stated_depth_sigma_m = options.stated_sideways_m = 0.02;
    const test::PoseWorld world = test::makePoseWorld(options);
    const Rigid start = disturbed(world.camera_from_map, 0.02, 0.03, &random);
    const Refinement refined = refinePose(spanOf(world), start, kScale2, 30);
    EXPECT_LT(test::rotationErrorRad(refined.camera_from_map, world.camera_from_map), 1e-6);
    EXPECT_LT(test::translationErrorM(refined.camera_from_map, world.camera_from_map), 1e-6);
  }
}

TEST(Refine, LetsGoOfFakes) {
  Random random(2);
  test::PoseWorldOptions options;
  options.true_share = 0.4;
  options.pixel_sigma_px = 0.8;
  options.depth_sigma_m = 0.01;
  const test::PoseWorld world = test::makePoseWorld(options);
  const Rigid start = disturbed(world.camera_from_map, 0.003, 0.005, &random);
  const Refinement refined = refinePose(spanOf(world), start, kScale2, 12);
  EXPECT_LT(test::rotationErrorRad(refined.camera_from_map, world.camera_from_map), 0.003);
  EXPECT_LT(test::translationErrorM(refined.camera_from_map, world.camera_from_map), 0.005);
}

TEST(Refine, NeverRaisesTheCost) {
  Random random(3);
  test::PoseWorldOptions options;
  options.true_share = 0.5;
  options.depth_sigma_m = 0.02;
  const test::PoseWorld world = test::makePoseWorld(options);
  for (int i = 0; i < 50; ++i) {
    const Rigid start = disturbed(world.camera_from_map, 0.1 * random.uniform(), 0.2 * random.uniform(), &random);
    double last = refinePose(spanOf(world), start, kScale2, 0).cost;
    for (int iterations = 1; iterations < 8; ++iterations) {
      const double cost = refinePose(spanOf(world), start, kScale2, iterations).cost;
      EXPECT_LE(cost, last + 1e-9);
      last = cost;
    }
  }
}

// The analytic Jacobian is hidden in the gradient of the step; at a small scale the normal matrix must be the
// second difference of the cost.
TEST(Refine, InformationIsTheCostsCurvature) {
  const test::PoseWorld world = test::makePoseWorld({});
  const auto costAt = [&](const Vector6 &step) {
    const Matrix3 turn = rotationFromVector(step.head<3>());
    const Rigid pose = {turn * world.camera_from_map.rotation,
                        turn * world.camera_from_map.translation_m + step.tail<3>()};
    double sum = 0;
    for (const Correspondence &c : world.correspondences) sum += residualOf(c, pose).squared;
    return sum;
  };
  const Matrix6 information = refinePose(spanOf(world), world.camera_from_map, 1e12, 0).information;
  constexpr double kStep = 1e-5;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j <= i; ++j) {
      const Vector6 a = kStep * Vector6::Unit(i), b = kStep * Vector6::Unit(j);
      const double numeric = (costAt(a + b) - costAt(a - b) - costAt(b - a) + costAt(-a - b)) / (8 * kStep * kStep);
      EXPECT_NEAR(information(i, j), numeric, 2e-3 * information.norm()) << i << " " << j;
    }
}

TEST(Refine, NothingToGoBy) {
  const Refinement refined = refinePose({}, Rigid(), kScale2, 5);
  EXPECT_EQ(refined.cost, 0);
  EXPECT_TRUE(isFinite(refined.camera_from_map.rotation.sum()));
}

}  // namespace
}  // namespace sphc
