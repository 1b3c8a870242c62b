#include "runtime/stages/pose/leverage.h"

#include <gtest/gtest.h>

#include "tests/support/random_numbers.h"
#include "tests/unit/runtime/stages/pose/pose_test_estimator.h"

namespace sphc {
namespace {

// Exact matches of a small patch, and two far beside it.
struct Patch {
  std::vector<Correspondence> correspondences;
  Estimate estimate;
};
constexpr uint32_t kOnPatch = 40;

Patch patchAndTwo() {
  Random random(4);
  Patch patch;
  patch.estimate.camera_from_map.translation_m = Vector3(0.1, 0.2, 1.5);
  const auto add = [&](const Vector3 &point_m) {
    patch.correspondences.push_back(
        {{point_m, 0.005, 0.01}, (point_m - patch.estimate.camera_from_map.translation_m).normalized()});
  };
  for (uint32_t i = 0; i < kOnPatch; ++i) add(Vector3(-0.8, 0.5, 2) + 0.1 * test::normalVector(&random));
  add({1, -0.4, 1.2});
  add({0.8, 0.4, 2.5});
  return patch;
}

Leverage leverageOf(const Patch &patch, uint32_t count) {
  return highestLeverage({patch.correspondences.data(), patch.correspondences.size()}, patch.estimate, count);
}

TEST(Leverage, IsThatOfTheMatchesThatHoldThePose) {
  const Leverage leverage = leverageOf(patchAndTwo(), 2);
  ASSERT_EQ(leverage.indices.size(), 2u);
  EXPECT_GE(leverage.indices[0], kOnPatch);
  EXPECT_GE(leverage.indices[1], kOnPatch);
  EXPECT_NE(leverage.indices[0], leverage.indices[1]);
  EXPECT_GT(leverage.centre_sigma_ratio, 2);
}

TEST(Leverage, WithoutThemTheCovarianceIsAsLarge) {
  test::TestEstimator estimator;
  Patch all = patchAndTwo();
  PoseQuery query;
  const auto sigma = [&](const Patch &patch) {
    query.correspondences = {patch.correspondences.data(), patch.correspondences.size()};
    const Estimate estimate = estimator.get().refine(query, patch.estimate.camera_from_map);
    return sqrtOf(estimate.covariance.bottomRightCorner<3, 3>().trace());
  };
  Patch few = all;
  few.correspondences.resize(kOnPatch);
  const double ratio = sigma(few) / sigma(all);
  EXPECT_NEAR(leverageOf(all, 2).centre_sigma_ratio / ratio, 1, 0.02);
}

TEST(Leverage, AWideSceneHasLittle) {
  const test::PoseWorld world = test::makePoseWorld({});
  Estimate estimate;
  estimate.camera_from_map = world.camera_from_map;
  const Leverage leverage =
      highestLeverage({world.correspondences.data(), world.correspondences.size()}, estimate, kMostHighLeverage);
  EXPECT_EQ(leverage.indices.size(), size_t{kMostHighLeverage});
  EXPECT_LT(leverage.centre_sigma_ratio, 1.1);
  EXPECT_EQ(highestLeverage({}, estimate, 3).indices.size(), 0u);
}

}  // namespace
}  // namespace sphc
