#include "host/mapping/adjustment.h"

#include <gtest/gtest.h>

#include <cmath>

#include "host/report/trajectory_score.h"
#include "made_up_walk.h"

namespace sphc::host {
namespace {

constexpr uint32_t kFrames = 24;

DepthCalibration priorOf(double slope_sigma) {
  DepthCalibration prior;
  prior.mid_m = kMadeUpMidM;
  prior.covariance.diagonal() << 0.003 * 0.003, slope_sigma * slope_sigma;
  return prior;
}

AdjustmentOptions steps(int most) {
  AdjustmentOptions options;
  options.most_steps = most;
  return options;
}

class AdjustmentTest : public testing::Test {
 protected:
  // Exact tracks, poses that are off by about 2 cm and 1 degree but for the first.
  Adjusted beginning(const MadeUpWalk &made) const {
    Adjusted adjusted;
    std::vector<FrameLink> links;
    for (uint32_t i = 0; i < kFrames; ++i)
      for (uint32_t j = i + 1; j < kFrames; ++j) {
        links.push_back(exactLink(made, {i, j}, kFrames - (j - i)));
        links.back().matches = matchAll(made.walk.keyframes[i], made.walk.keyframes[j]);
      }
    adjusted.tracks = tracksOf(made.walk.keyframes, links);
    for (uint32_t i = 0; i < kFrames; ++i) {
      const double s = 0.02 * std::sin(1.7 * i);
      const Rigid off = {rotationFromVector(Vector3(s, 0.5 * s, -s)), Vector3(s, -s, 0.5 * s)};
      adjusted.world_from_camera.push_back(made.world_from_camera[i] * off);
    }
    return adjusted;
  }
  TrajectoryScore score(const MadeUpWalk &made, const Adjusted &adjusted) const {
    std::vector<PosePair> pairs;
    for (uint32_t i = 0; i < kFrames; ++i)
      pairs.push_back({*adjusted.world_from_camera[i], made.world_from_camera[i]});
    return scoreTrajectory(pairs);
  }
};

TEST_F(AdjustmentTest, PosesAreFound) {
  const MadeUpWalk made = makeWalk({kFrames, 1, 1});
  Adjusted adjusted = beginning(made);
  const Rigid first = *adjusted.world_from_camera[0];
  EXPECT_GT(score(made, adjusted).rigid_rmse_m, 0.01);
  const AdjustmentSummary summary = adjust(made.walk.keyframes, priorOf(0.02), steps(60), &adjusted);
  const TrajectoryScore found = score(made, adjusted);
  EXPECT_LT(found.rigid_rmse_m, 0.003);
  EXPECT_LT(found.rotation_worst_deg, 0.6);  // the worlds are aligned by places on a circle of 1 m
  EXPECT_NEAR(found.scale, 1, 0.004);
  EXPECT_NEAR(summary.ray_sigmas, 1.0, 0.3);  // 1.18 less what the points take up
  EXPECT_NEAR(summary.depth_sigmas, 0.67, 0.15);
  EXPECT_LT((adjusted.world_from_camera[0]->translation_m - first.translation_m).norm(), 1e-12) << "the gauge";
}

// Depths that are told shorter must not make a smaller world better.
TEST_F(AdjustmentTest, NoisyDepthsDoNotShrinkTheWorld) {
  const MadeUpWalk made = makeWalk({kFrames, 1, 2});
  Adjusted adjusted = beginning(made);
  adjust(made.walk.keyframes, priorOf(0.02), {}, &adjusted);
  EXPECT_NEAR(score(made, adjusted).scale, 1, 0.008);
}

TEST_F(AdjustmentTest, TheBiasOfDepthsIsFound) {
  const MadeUpWalk made = makeWalk({kFrames, 1, 0.2, 0, 0.03});
  Adjusted adjusted = beginning(made);
  adjust(made.walk.keyframes, priorOf(0.5), steps(60), &adjusted);
  EXPECT_NEAR(adjusted.bias[1], 0.03, 0.006);
  EXPECT_NEAR(adjusted.bias[0], 0, 0.005);
}

// A calibration with a focal length that is 1.5 % too long, and a principal point that is 2 and 3 px off.
TEST_F(AdjustmentTest, WhatTheLensIsOffIsFound) {
  MadeUpWalk made = makeWalk({kFrames, 1, 0.5});
  CalibrationChange off;
  off.lens << -0.015, 0.004, -0.006;
  for (WalkFrame &frame : made.walk.keyframes)
    for (SeenPoint &seen : frame.points) seen.ray = assumedRay(seen.ray, off.lens.data());
  Adjusted adjusted = beginning(made), held = adjusted;
  AdjustmentOptions options = steps(60);
  const double with_it_held = adjust(made.walk.keyframes, priorOf(0.02), options, &held).ray_sigmas;
  EXPECT_EQ(held.change.lens.norm(), 0);
  options.lens_is_free = true;
  EXPECT_LT(adjust(made.walk.keyframes, priorOf(0.02), options, &adjusted).ray_sigmas, 0.9 * with_it_held);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(adjusted.change.lens[i], off.lens[i], 0.0015) << i;
  EXPECT_EQ(adjusted.change.mount.norm(), 0);
}

// A depth sensor that is turned by 0.4 degrees and shifted by a centimetre, before surfaces that face all ways.
TEST_F(AdjustmentTest, WhatTheDepthSensorIsOffItsPlaceIsFound) {
  MadeUpWalk made = makeWalk({kFrames, 1, 0.5});
  CalibrationChange off;
  off.mount << 0.004, -0.006, 0.003, 0.010, -0.008;
  for (WalkFrame &frame : made.walk.keyframes)
    for (size_t i = 0; i < frame.points.size(); ++i) {
      SeenPoint &seen = frame.points[i];
      const Vector2 slope(0.8 * std::sin(double(i)), 0.8 * std::cos(1.7 * double(i)));
      seen.depth_by_move << slope, 1 - slope.dot(seen.ray);
      seen.depth_m -= depthByMount(seen).dot(off.mount);
    }
  Adjusted adjusted = beginning(made);
  AdjustmentOptions options = steps(60);
  options.mount_is_free = true;
  adjust(made.walk.keyframes, priorOf(0.02), options, &adjusted);
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(adjusted.change.mount[i], off.mount[i], 0.0015) << i;
}

// Many sightings outvote the prior; what was changed before counts in it.
TEST_F(AdjustmentTest, AChangeIsHeldBackByWhatWasChangedBefore) {
  const MadeUpWalk made = makeWalk({kFrames, 1, 0.5});
  AdjustmentOptions options = steps(60);
  options.lens_is_free = true;
  Adjusted without = beginning(made), with = without;
  adjust(made.walk.keyframes, priorOf(0.02), options, &without);
  options.change_so_far.lens[0] = 0.5;
  adjust(made.walk.keyframes, priorOf(0.02), options, &with);
  EXPECT_LT(with.change.lens[0], without.change.lens[0] - 0.001);
}

TEST_F(AdjustmentTest, ASightingThatIsWrongLeavesItsTrack) {
  MadeUpWalk made = makeWalk({kFrames, 1, 0.5});
  Adjusted adjusted = beginning(made);
  const Sighting wrong = adjusted.tracks[0][1];
  made.walk.keyframes[wrong.frame].points[wrong.point].ray.x() += 0.05;
  adjust(made.walk.keyframes, priorOf(0.02), {}, &adjusted);
  ASSERT_FALSE(adjusted.tracks.empty());
  for (const Track &track : adjusted.tracks)
    for (const Sighting &s : track) EXPECT_FALSE(s.frame == wrong.frame && s.point == wrong.point);
}

// As of a calibration that puts depth beside where it belongs.
TEST_F(AdjustmentTest, DepthsThatContradictTheImagesAreCounted) {
  MadeUpWalk made = makeWalk({kFrames, 1, 1});
  Adjusted adjusted = beginning(made);
  EXPECT_LT(adjust(made.walk.keyframes, priorOf(0.02), {}, &adjusted).far_depths, 0.03);
  for (WalkFrame &frame : made.walk.keyframes)
    for (size_t i = 0; i < frame.points.size(); i += 6) frame.points[i].depth_m *= 1.2;
  EXPECT_GT(adjust(made.walk.keyframes, priorOf(0.02), {}, &adjusted).far_depths, 0.1);
}

TEST_F(AdjustmentTest, FramesWithoutAPoseTakeNoPart) {
  const MadeUpWalk made = makeWalk({kFrames, 1, 1});
  Adjusted adjusted = beginning(made);
  adjusted.world_from_camera[5].reset();
  adjust(made.walk.keyframes, priorOf(0.02), {}, &adjusted);
  EXPECT_FALSE(adjusted.world_from_camera[5]);
  for (const Track &track : adjusted.tracks)
    for (const Sighting &s : track) EXPECT_NE(s.frame, 5u);
}

}  // namespace
}  // namespace sphc::host
