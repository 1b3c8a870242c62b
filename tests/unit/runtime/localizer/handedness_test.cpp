#include "runtime/localizer/handedness.h"

#include <gtest/gtest.h>

#include <vector>

#include "runtime/localizer/tuning.h"
#include "tests/support/arena_memory.h"

namespace sphc {
namespace {

using namespace tuning;

// Seen from the sphere's centre, 2 m away, this many degrees to the right.
Correspondence seenAt(double degrees_right) {
  const Vector3 direction(std::sin(degrees(degrees_right)), 0, std::cos(degrees(degrees_right)));
  return {{2 * direction, 0.005, 0.01}, direction, 1};
}

std::vector<Correspondence> inSpots(uint32_t spots, uint32_t of_each) {
  std::vector<Correspondence> all;
  for (uint32_t spot = 0; spot < spots; ++spot)
    for (uint32_t i = 0; i < of_each; ++i) all.push_back(seenAt(20 * spot + 0.1 * i));
  return all;
}

Spread spread(const std::vector<Correspondence> &all) {
  PoseEstimator estimator;
  EstimatorConfig config;
  config.capacity = 16;
  config.max_iterations = 16;
  test::ArenaMemory memory(
      [&](Arena &arena, bool real) { PoseEstimator::layout(config, arena, real ? &estimator : nullptr); });
  return spreadOf({all.data(), all.size()}, Estimate(), estimator);
}

TEST(Handedness, WhatLiesInOneSpotIsNotElsewhere) {
  const Spread one = spread(inSpots(1, 30)), four = spread(inSpots(4, 30));
  EXPECT_EQ(one.inliers, 30u);
  EXPECT_EQ(one.elsewhere, 0u);
  EXPECT_EQ(four.inliers, 120u);
  EXPECT_EQ(four.elsewhere, 90u);
}

TEST(Handedness, OutliersAndRaysAreNotAsked) {
  std::vector<Correspondence> all = inSpots(2, 10);
  all[0].direction = Vector3::UnitY();
  all[1].lifted.along_m = std::numeric_limits<double>::infinity();
  EXPECT_EQ(spread(all).inliers, 18u);
}

TEST(Handedness, NoMoreAreAskedThanThereIsRoomFor) {
  EXPECT_EQ(spread(inSpots(2, kAskedForSpread)).inliers, kAskedForSpread);
}

TEST(Handedness, APoseOfManySpotsIsNoMirrorImage) {
  EXPECT_TRUE(mayBeMirrored({40, 0}));
  EXPECT_TRUE(mayBeMirrored({40, 27}));
  EXPECT_FALSE(mayBeMirrored({40, 29}));
  EXPECT_TRUE(mayBeMirrored({60, 29}));
  EXPECT_FALSE(mayBeMirrored({60, 30}));
  EXPECT_TRUE(mayBeMirrored({200, 69}));
  EXPECT_FALSE(mayBeMirrored({200, 71}));
}

TEST(Handedness, WhatLiesElsewhereDecides) {
  EXPECT_EQ(handednessOf({40, 11}, {60, 10}), Handedness::kKept);
  EXPECT_EQ(handednessOf({40, 10}, {41, 10}), Handedness::kUnclear);
  EXPECT_EQ(handednessOf({40, 10}, {40, 10}), Handedness::kKept);
  EXPECT_EQ(handednessOf({40, 9}, {20, 10}), Handedness::kUnclear);
  EXPECT_EQ(handednessOf({40, 5}, {60, 10}), Handedness::kChanged);
  EXPECT_EQ(handednessOf({0, 0}, {60, 10}), Handedness::kChanged);
}

TEST(Handedness, FewElsewhereNameNothing) { EXPECT_EQ(handednessOf({40, 0}, {60, 9}), Handedness::kUnclear); }

// A place that is seen from far away may be one spot.
TEST(Handedness, AMirrorImageWithoutAPoseSaysNothing) { EXPECT_EQ(handednessOf({40, 0}, {}), Handedness::kKept); }

}  // namespace
}  // namespace sphc
