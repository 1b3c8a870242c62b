#include "runtime/stages/pose/focal_scale.h"

#include <gtest/gtest.h>

#include "tests/unit/runtime/stages/pose/pose_test_estimator.h"

namespace sphc {
namespace {

constexpr double kDoubtful = 1.5;

// What a pose of matches says that were lifted by a focal length `stated_over_true` times too long.
struct Seen {
  test::PoseWorld world;
  Estimate estimate;
  DepthCalibration depth;
};

Seen see(double stated_over_true, uint64_t seed = 1, double wall_m = 0) {
  test::TestEstimator estimator;
  test::PoseWorldOptions options;
  options.seed = seed;
  options.depth_sigma_m = 0.01;
  options.pixel_sigma_px = 1;
  options.wall_m = wall_m;
  options.centre_offset_m.z() = -0.6 * wall_m;  // in the middle of the room
  Seen seen;
  seen.world = test::makePoseWorld(options);
  for (Correspondence &c : seen.world.correspondences) {
    c.lifted.point_m.x() /= stated_over_true;
    c.lifted.point_m.y() /= stated_over_true;
  }
  PoseQuery query;
  query.correspondences = {seen.world.correspondences.data(), seen.world.correspondences.size()};
  seen.estimate = estimator.get().refine(query, seen.world.camera_from_map);
  seen.depth = query.depth;
  return seen;
}

FocalScale scaleOf(const Seen &seen, const Deadline &deadline = {},
                   FocalDerivatives derivatives = FocalDerivatives::kAtFoot) {
  return focalScaleOf({seen.world.correspondences.data(), seen.world.correspondences.size()}, seen.estimate,
                      seen.depth, derivatives, kDoubtful, deadline);
}

TEST(FocalScale, IsThatByWhichMatchesWereLifted) {
  for (const double stated : {0.9, 0.95, 1.05, 1.1}) {
    const FocalScale scale = scaleOf(see(stated));
    EXPECT_NEAR(scale.off, stated - 1, 0.006) << stated;
    EXPECT_TRUE(scale.isBeyond(4)) << stated;
  }
}

// Over many worlds its error is what its sigma says.
TEST(FocalScale, KnowsItsError) {
  double squares = 0, worst = 0;
  constexpr uint32_t kWorlds = 100;
  for (uint64_t seed = 1; seed <= kWorlds; ++seed) {
    const FocalScale scale = scaleOf(see(1, seed));
    const double over_sigma = scale.off / scale.sigma;
    squares += over_sigma * over_sigma;
    worst = std::max(worst, absOf(over_sigma));
  }
  EXPECT_GT(squares / kWorlds, 0.5);
  EXPECT_LT(squares / kWorlds, 1.5);
  EXPECT_LT(worst, 4);
}

// Of a wall that is seen straight on no focal length shows: the camera may stand nearer, or further off.
TEST(FocalScale, IsNotReadOffTheNoiseOfAWall) {
  constexpr uint64_t kWorlds = 30;
  uint32_t doubtful = 0, scattered = 0;
  for (uint64_t seed = 1; seed <= kWorlds; ++seed) {
    const Seen wall = see(1, seed, 2.5);
    doubtful += scaleOf(wall).isBeyond(kDoubtful);
    scattered += scaleOf(wall, {}, FocalDerivatives::kAtPoint).isBeyond(kDoubtful);
  }
  EXPECT_LT(doubtful, kWorlds / 3);
  EXPECT_GT(scattered, kWorlds / 2);
}

// A further camera has a focal length of its own.
TEST(FocalScale, IsOfTheColourCameraAlone) {
  Seen seen = see(1.1);
  for (Correspondence &c : seen.world.correspondences) c.lifted.centre_m = {0.1f, 0, 0};
  const FocalScale scale = scaleOf(seen);
  EXPECT_EQ(scale.off, 0);
  EXPECT_FALSE(scale.isBeyond(kDoubtful));
}

TEST(FocalScale, IsUnknownWhereNothingTells) {
  Seen seen = see(1.1);
  const auto until = [](int64_t time_ns) {
    return Deadline{{[](void *) { return int64_t{5}; }, nullptr}, time_ns};
  };
  EXPECT_FALSE(scaleOf(seen, until(4)).isBeyond(1));
  EXPECT_TRUE(scaleOf(seen, until(6)).isBeyond(4));
  seen.world.correspondences.clear();
  EXPECT_FALSE(scaleOf(seen).isBeyond(1));
}

}  // namespace
}  // namespace sphc
