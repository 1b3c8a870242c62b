// The claims of the paper (Moon et al., BMVC 2024), in miniature.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/support/pose_world.h"
#include "tests/support/random_numbers.h"
#include "tests/unit/runtime/stages/pose/pose_test_estimator.h"

namespace sphc {
namespace {

struct Errors {
  double rotation_rad, translation_m;
};

// Medians over worlds.
Errors medianErrors(test::PoseWorldOptions options, uint32_t worlds) {
  test::TestEstimator estimator;
  std::vector<double> rotation, translation;
  for (uint64_t seed = 1; seed <= worlds; ++seed) {
    options.seed = seed;
    const test::PoseWorld world = test::makePoseWorld(options);
    const Estimate estimate = estimator.search(world, seed);
    rotation.push_back(test::rotationErrorRad(estimate.camera_from_map, world.camera_from_map));
    translation.push_back(test::translationErrorM(estimate.camera_from_map, world.camera_from_map));
  }
  std::nth_element(rotation.begin(), rotation.begin() + worlds / 2, rotation.end());
  std::nth_element(translation.begin(), translation.begin() + worlds / 2, translation.end());
  return {rotation[worlds / 2], translation[worlds / 2]};
}

// Section 3.3 and supplement 1.1: a direction of the wrong sign is no inlier.
TEST(PaperClaims, WrongSignDirectionsAreRefusedByCheirality) {
  test::PoseWorld world = test::makePoseWorld({});
  for (size_t i = 0; i < world.correspondences.size(); i += 3)
    world.correspondences[i].direction = -world.correspondences[i].direction;
  test::TestEstimator estimator;
  const Estimate estimate = estimator.search(world);
  EXPECT_LT(test::translationErrorM(estimate.camera_from_map, world.camera_from_map), 1e-3);
  EXPECT_EQ(estimate.inliers, 200u);
  for (size_t i = 0; i < world.correspondences.size(); ++i)
    EXPECT_EQ(estimator.get().isInlier(world.correspondences[i], estimate), i % 3 != 0);
}

// The mirror world: with every sign wrong the lines still meet their points, the rays do not.  A few agree all the
// same: turning a plane by 180 degrees about its normal mirrors it.
TEST(PaperClaims, AllSignsWrongIsNoMap) {
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    test::PoseWorldOptions options;
    options.seed = seed;
    test::PoseWorld world = test::makePoseWorld(options);
    for (Correspondence &c : world.correspondences) c.direction = -c.direction;
    test::TestEstimator estimator(300, 3000);
    EXPECT_LT(estimator.search(world).inliers, 30u) << "of 300";
    Estimate truth;
    truth.camera_from_map = world.camera_from_map;
    for (const Correspondence &c : world.correspondences) EXPECT_FALSE(estimator.get().isInlier(c, truth));
  }
}

// The paper's oracle-depth experiment: depth is what limits the accuracy.
TEST(PaperClaims, ErrorFallsWithOracleDepth) {
  test::PoseWorldOptions options;
  options.true_share = 0.33;
  options.pixel_sigma_px = 0.5;
  options.stated_depth_sigma_m = 0.04;
  options.depth_sigma_m = 0.04;
  const Errors noisy = medianErrors(options, 15);
  options.stated_depth_sigma_m = 0.005;
  options.depth_sigma_m = 0;
  const Errors oracle = medianErrors(options, 15);
  EXPECT_LT(2 * oracle.translation_m, noisy.translation_m);
  EXPECT_LT(oracle.rotation_rad, noisy.rotation_rad);
  EXPECT_LT(noisy.translation_m, 0.03);
}

// Supplement, table of centre locations: rays from far away are nearly parallel and no longer tell where along them
// the camera is.
TEST(PaperClaims, ADistantCentreRuinsTranslation) {
  test::PoseWorldOptions options;
  options.true_share = 0.5;
  options.pixel_sigma_px = 0.5;
  options.depth_sigma_m = options.stated_depth_sigma_m = 0.01;
  std::vector<Errors> rows;
  for (double distance_m : {0.0, 5.0, 25.0, 125.0}) {
    options.centre_offset_m = Vector3(0.6, -0.64, 0.48) * distance_m;
    rows.push_back(medianErrors(options, 11));
    ::testing::Test::RecordProperty("translation_mm_at_" + std::to_string(static_cast<int>(distance_m)) + "_m",
                                    std::to_string(1000 * rows.back().translation_m));
  }
  for (size_t i = 1; i < rows.size(); ++i) EXPECT_GT(rows[i].translation_m, 1.5 * rows[i - 1].translation_m) << i;
  EXPECT_GT(rows[3].translation_m, 20 * rows[0].translation_m);
}

// Depths that measure nothing: directions alone must not make a pose that many believe in.  The bearings are right,
// so that here and there a depth fits; a few such poses pass for true.
TEST(PaperClaims, RandomDepthsSeldomGiveAPose) {
  test::TestEstimator estimator(300, 3000);
  int localized = 0;
  constexpr int kScenes = 40;
  for (uint64_t seed = 1; seed <= kScenes; ++seed) {
    test::PoseWorldOptions options;
    options.seed = seed;
    test::PoseWorld world = test::makePoseWorld(options);
    Random random(seed);
    for (Correspondence &c : world.correspondences)
      c.lifted.point_m *= test::uniformIn(&random, 0.5, 5) / c.lifted.point_m.z();
    const Estimate estimate = estimator.search(world, seed);
    EXPECT_LT(estimate.inliers, 20u) << "of 300";
    localized += estimator.judge(world, estimate) == Outcome::kLocalized;
  }
  RecordProperty("localized_of_40", localized);
  EXPECT_LE(localized, kScenes / 4);
}

}  // namespace
}  // namespace sphc
