#include "host/calibration/compare.h"

#include <gtest/gtest.h>

namespace sphc::host {
namespace {

sphc_rig example() {
  sphc_rig c;
  sphc_rig_init(&c);
  c.color_camera = {SPHC_CAMERA_PINHOLE, 640, 480, 4, {500, 500, 320, 240}};
  c.depth_camera = {SPHC_CAMERA_PINHOLE, 320, 240, 4, {250, 250, 160, 120}};
  c.color_from_depth.t_m[0] = 0.02;
  return c;
}

TEST(Compare, TheSameIsTheSame) {
  const CalibrationDifference difference = compareCalibrations(example(), example());
  EXPECT_LT(difference.largestPx(), 1e-10);
  EXPECT_EQ(difference.lost(), 0u);
  EXPECT_GT(difference.color.samples, 3000u);
}

TEST(Compare, AMovedPrincipalPointIsSeenWhereItActs) {
  sphc_rig moved = example();
  moved.color_camera.params[2] += 0.5;
  const CalibrationDifference difference = compareCalibrations(example(), moved);
  EXPECT_NEAR(difference.color.largest_px, 0.5, 1e-9);
  EXPECT_NEAR(difference.color.rms_px, 0.5, 1e-9);
  EXPECT_LT(difference.depth.largest_px, 1e-9);
  EXPECT_NEAR(difference.depth_to_color[2].rms_px, 0.5, 1e-9);
}

TEST(Compare, ABaselineCountsByDepth) {
  sphc_rig moved = example();
  moved.color_from_depth.t_m[0] += 0.001;
  const CalibrationDifference difference = compareCalibrations(example(), moved);
  EXPECT_LT(difference.color.largest_px, 1e-9);
  for (size_t i = 0; i < kComparedDepthsM.size(); ++i)
    EXPECT_NEAR(difference.depth_to_color[i].largest_px, 500 * 0.001 / kComparedDepthsM[i], 1e-9);
}

TEST(Compare, WhatIsSeenNoLongerIsCounted) {
  sphc_rig folded = example();
  folded.color_camera = {SPHC_CAMERA_BROWN5, 640, 480, 9, {500, 500, 320, 240, -2, 0, 0, 0, 0}};
  const CalibrationDifference difference = compareCalibrations(example(), folded);
  EXPECT_GT(difference.color.lost, 100u);
  EXPECT_GT(difference.lost(), difference.color.lost);
}

}  // namespace
}  // namespace sphc::host
