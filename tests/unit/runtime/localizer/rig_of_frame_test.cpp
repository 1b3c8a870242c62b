#include "runtime/localizer/rig_of_frame.h"

#include <gtest/gtest.h>

#include "tests/support/scene.h"

namespace sphc {
namespace {

constexpr int64_t kStep = 33000000;
constexpr uint8_t kByte = 0;  // some image

Rigid beside(double x_m) { return {Matrix3::Identity(), Vector3(x_m, 0, 0)}; }

// A colour camera with a depth camera 4 cm, and a further one 6 cm, beside it.
LocalizerConfig configOfThree() {
  LocalizerConfig config;
  config.depth.push({});
  RigCamera further;
  further.color_from_camera = beside(0.06);
  config.further.push(further);
  return config;
}

FrameInput frameAt(int64_t time_ns) {
  FrameInput frame;
  frame.color_time_ns = time_ns;
  DepthView depth;
  depth.depth.data = &kByte;
  depth.time_ns = time_ns;
  depth.color_from_depth = beside(0.04);
  frame.depth.push(depth);
  FurtherView further;
  further.time_ns = time_ns;
  frame.further.push(further);
  return frame;
}

double xOf(const Rigid &transform) { return transform.translation_m.x(); }

TEST(RigOfFrame, OfOneTimeIsAsItWasBuilt) {
  const RigOfFrame rig = rigOfFrame(configOfThree(), frameAt(kStep), seenBit(0), nullptr, {});
  EXPECT_EQ(xOf(rig.cameras.depth[0].color_from_depth), 0.04);
  EXPECT_EQ(xOf(rig.cameras.further[0].color_from_camera), 0.06);
  EXPECT_EQ(rig.between.shift_sigma_m, 0);
  EXPECT_TRUE(rig.cameras.teaches);
}

TEST(RigOfFrame, WithoutATrackerTheWayIsUnknown) {
  FrameInput frame = frameAt(10 * kStep);
  frame.depth[0].time_ns -= 3 * kStep;
  const RigOfFrame rig = rigOfFrame(configOfThree(), frame, seenBit(0), nullptr, {});
  EXPECT_EQ(xOf(rig.cameras.depth[0].color_from_depth), 0.04);
  EXPECT_NEAR(rig.between.apart_s, 0.099, 1e-9);
  EXPECT_TRUE(rig.between.areApart());
  EXPECT_TRUE(rig.between_first_depth.areApart());
  EXPECT_FALSE(rig.cameras.teaches);
}

// Depth goes along the rays of the colour image; a view has rays of its own.
TEST(RigOfFrame, AViewTurnsWithTheHead) {
  FrameInput of_depth = frameAt(10 * kStep), of_view = of_depth;
  of_depth.depth[0].time_ns -= 20000000;
  of_view.further[0].time_ns += 20000000;
  const auto between = [](const FrameInput &frame) {
    return rigOfFrame(configOfThree(), frame, seenBit(0), nullptr, {}).between;
  };
  EXPECT_NEAR(between(of_depth).turnSigma(), 0.02 * tuning::kTurnApart, 1e-12);
  EXPECT_NEAR(between(of_view).turnSigma(), 0.02 * tuning::kTurnRate, 1e-12);
  EXPECT_EQ(between(of_view).shiftSigma(), between(of_depth).shiftSigma());
}

TEST(RigOfFrame, AnImageThatIsNotThereDoesNotCount) {
  FrameInput frame = frameAt(10 * kStep);
  frame.further[0].time_ns = 0;
  EXPECT_TRUE(rigOfFrame(configOfThree(), frame, seenBit(0), nullptr, {}).between.areApart());
  EXPECT_FALSE(rigOfFrame(configOfThree(), frame, seenBit(0), nullptr, {}).between_first_depth.areApart());
  EXPECT_EQ(rigOfFrame(configOfThree(), frame, 0, nullptr, {}).between.apart_s, 0);
  frame.depth[0].time_ns = 0;
  frame.depth[0].depth.data = nullptr;
  EXPECT_EQ(rigOfFrame(configOfThree(), frame, 0, nullptr, {}).between.apart_s, 0);
}

// The camera goes 1 cm a frame along x, so what it saw two frames ago lies 2 cm behind.
TEST(RigOfFrame, OdometryTakesImagesToTheTimeOfColour) {
  Tracker tracker;
  for (int i = 1; i <= 4; ++i) {
    const Odometry odometry = {beside(0.01 * i), 0.0001, 0.001};
    tracker.advance(i * kStep, &odometry);
  }
  FrameInput frame = frameAt(4 * kStep);
  frame.depth[0].time_ns -= 2 * kStep;
  const RigOfFrame rig =
      rigOfFrame(configOfThree(), frame, seenBit(0), &tracker, {Vector3::Zero(), Vector3(0.3, 0, 0), 0, 0});
  EXPECT_NEAR(xOf(rig.cameras.depth[0].color_from_depth), 0.04 - 0.02, 1e-9);
  EXPECT_EQ(xOf(rig.cameras.further[0].color_from_camera), 0.06);
  EXPECT_EQ(rig.between.apart_s, 0);
  EXPECT_GT(rig.between.shift_sigma_m, 0.001);
  EXPECT_FALSE(rig.between.areApart());
  EXPECT_EQ(rig.cameras.motion.shift_m_s.x(), 0.3);
}

// Of the camera's rate its sigma counts, for half of the time from the first row to the last.
TEST(RigOfFrame, WhatIsUnknownOfTheRateCountsWhileRowsAreExposed) {
  constexpr uint32_t kHeight = 480, kHeightOfFurther = 360;
  constexpr double kHalfS = kHeight / 2 * 20e-6;
  LocalizerConfig config = configOfThree();
  config.color_camera = Camera(test::pinhole(640, kHeight, 500));
  config.further[0].camera = Camera(test::pinhole(480, kHeightOfFurther, 400));
  const CameraRate rate = {Vector3::Zero(), Vector3::Zero(), 0.4, 0.3};
  const auto between = [&](SeenCameras seen) {
    return rigOfFrame(config, frameAt(kStep), seen, nullptr, rate).between;
  };
  EXPECT_EQ(between(seenBit(0)).turnSigma(), 0) << "all rows at once";
  for (const double row_time_s : {20e-6, -20e-6}) {
    config.color_row_time_s = row_time_s;
    EXPECT_NEAR(between(0).turnSigma(), 0.4 * kHalfS, 1e-12);
    EXPECT_NEAR(between(0).shiftSigma(), 0.5 * kHalfS, 1e-12) << "and the turn's, a metre away";
  }
  config.further[0].row_time_s = 80e-6;
  EXPECT_NEAR(between(seenBit(0)).turnSigma(), 0.4 * kHeightOfFurther / 2 * 80e-6, 1e-12);
  EXPECT_NEAR(between(0).turnSigma(), 0.4 * kHalfS, 1e-12) << "it is not there";
}

// An image that is bent by rows is of one time all the same.
TEST(RigOfFrame, RowsDoNotMakeImagesApart) {
  LocalizerConfig config = configOfThree();
  config.color_camera = Camera(test::pinhole(640, 1080, 500));
  config.color_row_time_s = 30e-6;
  const RigOfFrame rig = rigOfFrame(config, frameAt(kStep), 0, nullptr, {});
  EXPECT_GT(rig.between.shiftSigma(), 0.015);
  EXPECT_FALSE(rig.between.areApart());
  EXPECT_TRUE(rig.cameras.teaches);
}

}  // namespace
}  // namespace sphc
