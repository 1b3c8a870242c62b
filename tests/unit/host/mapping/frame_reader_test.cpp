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

TEST(FrameReaderTest, FramesOfLittleWorthSayWhy) {
  EXPECT_TRUE(describe({0, 128, 2000}).hints & kTooPlain);
  EXPECT_TRUE(describe({0, 3, 2000}).hints & kTooDark);
  EXPECT_TRUE(describe({400, 128, 0}).hints & kNoDepthInRange);
}

}  // namespace
}  // namespace sphc::host
