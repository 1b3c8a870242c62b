#include "runtime/localizer/front_end.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "runtime/localizer/tuning.h"
#include "tests/unit/runtime/localizer/room_parts.h"

namespace sphc {
namespace {

class FrontEndTest : public testing::Test {
 protected:
  void SetUp() override { parts_.see(1); }
  FrontEnd &front() { return parts_.front; }

  test::RoomParts parts_;
};

TEST_F(FrontEndTest, KeypointsWithDepthComeFirst) {
  ASSERT_GT(front().liftedCount(), 100u);
  ASSERT_LT(front().liftedCount(), front().keypointCount()) << "the frame has no keypoint without depth";
  for (uint32_t i = 0; i < front().keypointCount(); ++i)
    EXPECT_EQ(front().lifted()[i].hasDepth(), i < front().liftedCount()) << i;
}

TEST_F(FrontEndTest, WhatIsToldOfAKeypointIsOfTheSameOne) {
  const Camera &camera = parts_.config.color_camera;
  for (uint32_t i = 0; i < front().keypointCount(); ++i) {
    const Observation &o = front().observationOf(i);
    EXPECT_EQ(o.lifted, i < front().liftedCount());
    const LiftedPoint &point = front().lifted()[i];
    EXPECT_FLOAT_EQ(o.depth_m, o.lifted ? static_cast<float>(point.point_m.z()) : 0.0f);
    Vector2 pixel_px;
    ASSERT_TRUE(camera.project(point.point_m, &pixel_px));
    EXPECT_NEAR(pixel_px.x(), static_cast<double>(o.x_px), 1e-3);
    EXPECT_NEAR(pixel_px.y(), static_cast<double>(o.y_px), 1e-3);
  }
}

// Keypoints change places when those with depth come first: their descriptors go with them.
TEST_F(FrontEndTest, DescriptorsGoWithTheirKeypoints) {
  const std::vector<Descriptor> described(front().descriptors().begin(), front().descriptors().end());
  // Extracted again, and not lifted, they are in the order of keypoints, as observations are.
  const auto made = test::sceneFrame(test::sceneConfig(), 1);
  front().extract(frameFrom(made->frame, MapSet()).color, {});
  EXPECT_EQ(front().liftedCount(), 0u);
  ASSERT_EQ(front().keypointCount(), described.size());
  bool some_moved = false;
  for (uint32_t i = 0; i < front().keypointCount(); ++i) {
    const auto keypoint = static_cast<size_t>(&front().observationOf(i) - front().observations().data());
    EXPECT_EQ(std::memcmp(&described[i], &front().descriptors()[keypoint], sizeof(Descriptor)), 0) << i;
    some_moved |= keypoint != i;
  }
  EXPECT_TRUE(some_moved);
}

TEST_F(FrontEndTest, MirroredTwiceAFrameIsItselfAgain) {
  const std::vector<Descriptor> described(front().descriptors().begin(), front().descriptors().end());
  const std::vector<LiftedPoint> lifted(front().lifted().begin(), front().lifted().end());
  front().mirror();
  for (uint32_t i = 0; i < front().keypointCount(); ++i) {
    EXPECT_NE(std::memcmp(&described[i], &front().descriptors()[i], sizeof(Descriptor)), 0) << i;
    EXPECT_EQ(front().lifted()[i].point_m, Vector3(-1, 1, 1).cwiseProduct(lifted[i].point_m));
  }
  front().mirror();
  for (uint32_t i = 0; i < front().keypointCount(); ++i) {
    EXPECT_EQ(std::memcmp(&described[i], &front().descriptors()[i], sizeof(Descriptor)), 0) << i;
    EXPECT_EQ(front().lifted()[i].point_m, lifted[i].point_m);
  }
}

// Red alone has a weight that neither green nor blue has (gray.h).
TEST_F(FrontEndTest, ColourIsReadInItsOrder) {
  const auto made = test::sceneFrame(test::sceneConfig(), 1);
  std::vector<uint8_t> dark, rgb, bgr;
  for (const uint8_t red : made->images.gray) {
    dark.push_back(static_cast<uint8_t>((77 * red + 128) / 256));
    rgb.insert(rgb.end(), {red, 0, 0});
    bgr.insert(bgr.end(), {0, 0, red});
  }
  const auto describe = [&](const ColorView &color) {
    front().extract(color, {});
    const auto *first = reinterpret_cast<const char *>(front().descriptors().data());
    return std::string(first, front().keypointCount() * sizeof(Descriptor));
  };
  LumaLayout plane, three;
  three.group_bytes = 3;
  const std::string expected = describe({{dark.data(), 320, 240, 320}, plane});
  EXPECT_FALSE(expected.empty());
  three.kind = LumaLayout::kRgb;
  EXPECT_EQ(describe({{rgb.data(), 320, 240, 3 * 320}, three}), expected);
  three.kind = LumaLayout::kBgr;
  EXPECT_EQ(describe({{bgr.data(), 320, 240, 3 * 320}, three}), expected);
}

TEST_F(FrontEndTest, CoarseKeypointsArePlacedLessExactly) {
  const double focal_px = parts_.config.color_camera.focal();
  bool some_are_coarse = false;
  for (uint32_t i = 0; i < front().liftedCount(); ++i) {
    const double scale_px = static_cast<double>(front().observationOf(i).scale_px);
    const double coarseness = std::max(1.0, scale_px / tuning::kFineScalePx);
    const double across_m = parts_.config.pixel_sigma_px * coarseness * front().lifted()[i].point_m.z() / focal_px;
    EXPECT_NEAR(front().lifted()[i].sideways_m, std::hypot(across_m, parts_.config.map_sigma_m), 1e-9);
    some_are_coarse |= coarseness > 1.5;
  }
  EXPECT_TRUE(some_are_coarse);
}

// A pixel of a fisheye is an angle, whatever the angle from the axis is: at 60 degrees twice as far across as by z.
TEST_F(FrontEndTest, APixelOfAFisheyeIsAnAngle) {
  sphc_camera fisheye = parts_.config.color_camera.parameters();
  fisheye.model = SPHC_CAMERA_KANNALA_BRANDT4;
  fisheye.param_count = 8;
  fisheye.params[0] = fisheye.params[1] = 130;
  parts_.config.color_camera = parts_.config.depth[0].camera = Camera(fisheye);
  parts_.config.depth[0].color_from_depth = {};
  parts_.lift(std::vector<uint16_t>(size_t{fisheye.width} * fisheye.height, 1500));
  double widest_rad = 0;
  for (uint32_t i = 0; i < front().liftedCount(); ++i) {
    const LiftedPoint &lifted = front().lifted()[i];
    const double scale_px = static_cast<double>(front().observationOf(i).scale_px);
    const double sigma_px = parts_.config.pixel_sigma_px * std::max(1.0, scale_px / tuning::kFineScalePx);
    EXPECT_NEAR(lifted.sideways_m, std::hypot(sigma_px / 130 * lifted.point_m.norm(), parts_.config.map_sigma_m),
                1e-9);
    widest_rad = std::max(widest_rad, angleBetween(lifted.point_m, Vector3::UnitZ()));
  }
  EXPECT_GT(widest_rad, 1);
}

TEST_F(FrontEndTest, RaysAreUnitBearings) {
  for (uint32_t i = front().liftedCount(); i < front().keypointCount(); ++i) {
    EXPECT_NEAR(front().lifted()[i].point_m.norm(), 1, 1e-12);
    EXPECT_LT(front().lifted()[i].sideways_m, 1);
  }
}

}  // namespace
}  // namespace sphc
