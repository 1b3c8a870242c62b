#include "host/mapping/frame_reader.h"

#include <gtest/gtest.h>

#include <cmath>

#include "spotted_images.h"

namespace sphc::host {
namespace {

WalkFrame describe(const SpottedImages &images) {
  return FrameReader(spottedRig(), {}).describe(images.frame(0, 0));
}

TEST(FrameReaderTest, KeypointsHaveRaysAndDepths) {
  const WalkFrame frame = describe({400, 128, 2000});
  ASSERT_GT(frame.points.size(), 100u);
  ASSERT_EQ(frame.descriptors.size(), frame.points.size());
  for (const SeenPoint &point : frame.points) {
    EXPECT_LE(std::abs(point.ray.x()), 0.5 * kSpottedWidth / kSpottedFocalPx);
    EXPECT_NEAR(point.bearing.norm(), 1, 1e-12);
    EXPECT_GE(point.sigma, 0.5 / kSpottedFocalPx);
    if (point.hasDepth()) {
      EXPECT_NEAR(point.point_m().z(), 2, 1e-3);
    }
  }
  EXPECT_EQ(frame.hints, 0u);
}

// A wall that is turned comes nearer where the sensor is shifted along it, and one ahead does not.
TEST(FrameReaderTest, SurfacesSayHowDepthFollowsAMove) {
  SpottedImages images(400, 128, 2000);
  images.slant(0.3);
  FrameReaderOptions options;
  options.surfaces = true;
  const WalkFrame frame = FrameReader(spottedRig(), options).describe(images.frame(0, 0));
  size_t sloped = 0;
  for (const SeenPoint &point : frame.points) {
    if (!point.hasDepth() || point.depth_by_move == Vector3::UnitZ()) continue;
    const Vector2 slope(0.3 * point.depth_m, 0);
    const Vector3 expected(slope.x(), slope.y(), 1 - slope.dot(point.ray));
    EXPECT_LT((point.depth_by_move - expected).norm(), 0.1);  // depths are whole millimetres
    ++sloped;
  }
  EXPECT_GT(sloped, 100u);
  for (const SeenPoint &point : describe({400, 128, 2000}).points) EXPECT_EQ(point.depth_by_move, Vector3::UnitZ());
}

TEST(FrameReaderTest, FramesOfLittleWorthSayWhy) {
  EXPECT_TRUE(describe({0, 128, 2000}).hints & kTooPlain);
  EXPECT_TRUE(describe({0, 3, 2000}).hints & kTooDark);
  EXPECT_TRUE(describe({400, 128, 0}).hints & kNoDepthInRange);
}

TEST(FrameReaderTest, WhatWasMeasuredOfTheImagesIsKept) {
  const ImageEvidence sound = describe({400, 128, 2000}).evidence;
  EXPECT_NEAR(sound.level, 128, 20);
  EXPECT_GT(sound.keypoints, 100);
  EXPECT_GT(sound.with_depth, 0.9);
  EXPECT_EQ(sound.nearer + sound.farther, 0);
  EXPECT_EQ(describe({400, 128, 200}).evidence.nearer, 1);
  EXPECT_EQ(describe({400, 128, 7000}).evidence.farther, 1);
  EXPECT_EQ(describe({400, 128, 0}).evidence.with_depth, 0);
}

}  // namespace
}  // namespace sphc::host
