// Frames that follow each other, on the test rooms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "runtime/base/random.h"
#include "runtime/localizer/localizer.h"
#include "tests/support/session.h"

namespace sphc {
namespace {

constexpr int64_t kStepNs = 100000000;

sphc_localizer_config trackingConfig() {
  sphc_localizer_config config = test::sceneConfig();
  config.mode = SPHC_MODE_TRACKING;
  return config;
}

class Walk {
 public:
  explicit Walk(const sphc_localizer_config &config, double eta = 0.5, uint32_t rooms = 1)
      : config_(config), session_(config, eta, rooms) {}

  test::Session &session() { return session_; }
  // The next frame, a tenth of a second later.
  sphc_localizer_result see(uint32_t viewpoint, uint32_t room = 0, bool dark = false) {
    const auto made = test::sceneFrame(zoomed(), viewpoint, room);
    if (upper_share_ < 1) copyBelow(*test::sceneFrame(zoomed(), below_, room), made.get());
    if (dark) std::fill(made->images.gray.begin(), made->images.gray.end(), uint8_t{9});
    for (uint16_t &depth : made->images.depth_mm) depth = static_cast<uint16_t>(depth_scale_ * depth);
    sphc_localizer_frame frame = made->frame;
    frame.color_time_ns = frame.depth_time_ns = time_ns_ += kStepNs;
    sphc_localizer_prior prior = {};
    if (odometry_) {
      prior.struct_size = sizeof prior;
      prior.flags = SPHC_PRIOR_ODOMETRY;
      const Rigid here = sceneViewpoint(viewpoint - odometry_behind_);
      prior.odometry_from_camera = rigidToC(odometry_is_inverted_ ? here : here.inverse());
      for (double &shift_m : prior.odometry_from_camera.t_m)
        shift_m = odometry_scale_ * shift_m + odometry_shift_m_;
      prior.odometry_rotation_sigma_rad = 1e-3;
      prior.odometry_translation_sigma_m = 1e-3;
      frame.prior = &prior;
    }
    sphc_localizer_result result = {};
    session_.process(frame, &result);
    if (result.outcome == SPHC_OUTCOME_LOCALIZED) {
      EXPECT_EQ(result.map_id, room);
      if (depth_scale_ == 1 && zoom_ == 1) {
        EXPECT_LT(session_.errorM(result, viewpoint), 0.03) << viewpoint;
      }
    }
    return result;
  }
  std::vector<sphc_localizer_observation> observations() {
    std::vector<sphc_localizer_observation> all(config_.max_keypoints);
    uint32_t count = 0;
    sphc_localizer_observations(session_.localizer(), all.data(), sizeof all[0], config_.max_keypoints, &count);
    all.resize(count);
    return all;
  }
  uint32_t pointsOf(uint32_t map) {
    sphc_map_info info = {};
    info.struct_size = sizeof info;
    sphc_map_get_info(session_.map(map), &info);
    return info.point_count;
  }
  void useOdometry() { odometry_ = true; }
  // Odometry that tells so many viewpoints less than there were.
  void keepOdometryBehind(uint32_t viewpoints) { odometry_behind_ = viewpoints; }
  void scaleOdometry(double scale) { odometry_scale_ = scale; }
  // From now on in a frame of its own that lies elsewhere, as after a loop is closed.
  void shiftOdometry(double shift_m) { odometry_shift_m_ = shift_m; }
  void invertOdometry() { odometry_is_inverted_ = true; }
  // From now on all depths are so many times as large.
  void scaleDepth(double scale) { depth_scale_ = scale; }
  // From now on the cameras' focal lengths are so many times those that were stated.
  void zoom(double true_over_stated) { zoom_ = true_over_stated; }
  // From now on what is seen is below this share of the rows what another viewpoint sees.
  void showBelow(double share, uint32_t viewpoint) {
    upper_share_ = share;
    below_ = viewpoint;
  }
  void forget() { sphc_localizer_reset(session_.localizer()); }
  void setClockBack() { time_ns_ -= 2 * kStepNs; }
  void replaceMap() { ASSERT_EQ(sphc_localizer_set_map(session_.localizer(), 0, session_.map()), SPHC_OK); }
  void takeMapAwayAndGiveItBack() {
    ASSERT_EQ(sphc_localizer_remove_map(session_.localizer(), 0), SPHC_OK);
    replaceMap();
  }

 private:
  static Rigid sceneViewpoint(uint32_t i) { return test::sceneViewpoint(i); }
  void copyBelow(const test::SceneFrame &other, test::SceneFrame *made) const {
    const auto copy = [this](const auto &from, auto *to) {
      const auto border = static_cast<ptrdiff_t>(upper_share_ * static_cast<double>(from.size()));
      std::copy(from.begin() + border, from.end(), to->begin() + border);
    };
    copy(other.images.gray, &made->images.gray);
    copy(other.images.depth_mm, &made->images.depth_mm);
  }
  sphc_localizer_config zoomed() const {
    sphc_localizer_config config = config_;
    for (sphc_camera *camera : {&config.rig.color_camera, &config.rig.depth_camera})
      for (int i = 0; i < 2; ++i) camera->params[i] *= zoom_;
    return config;
  }

  sphc_localizer_config config_;
  test::Session session_;
  int64_t time_ns_ = 0;
  bool odometry_ = false;
  uint32_t odometry_behind_ = 0;
  bool odometry_is_inverted_ = false;
  double depth_scale_ = 1;
  double zoom_ = 1;
  double odometry_scale_ = 1, odometry_shift_m_ = 0;
  double upper_share_ = 1;
  uint32_t below_ = 0;
};

TEST(LocalizerTracking, AWalkIsTrackedOnceItIsConfirmed) {
  Walk walk(trackingConfig());
  const sphc_localizer_result first = walk.see(0);
  EXPECT_EQ(first.outcome, SPHC_OUTCOME_LOCALIZED);
  EXPECT_EQ(first.state, SPHC_STATE_RELOCALIZING);
  EXPECT_EQ(first.guided, 0u);
  EXPECT_EQ(walk.see(1).state, SPHC_STATE_TRACKING);
  for (uint32_t viewpoint : {2u, 3u, 4u}) {
    const sphc_localizer_result result = walk.see(viewpoint);
    EXPECT_EQ(result.state, SPHC_STATE_TRACKING) << viewpoint;
    EXPECT_EQ(result.guided, 1u) << viewpoint;
    EXPECT_EQ(result.frames, 1u);
  }
}

// The first pose has a near rival.
TEST(LocalizerTracking, ATrackThatIsNotSureBecomesSoInTheWholeMap) {
  for (const bool shows_two_places : {false, true}) {
    Walk walk(trackingConfig());
    walk.useOdometry();
    walk.showBelow(0.55, 4);
    ASSERT_DOUBLE_EQ(walk.see(0).confidence, 0.95);
    walk.showBelow(shows_two_places ? 0.5 : 1, 4);
    const sphc_localizer_result next = walk.see(1);
    EXPECT_EQ(next.guided, 1u);
    EXPECT_EQ(next.state, shows_two_places ? SPHC_STATE_RELOCALIZING : SPHC_STATE_TRACKING);
    EXPECT_EQ(next.outcome, shows_two_places ? SPHC_OUTCOME_UNCERTAIN : SPHC_OUTCOME_LOCALIZED);
    EXPECT_EQ(next.hints, shows_two_places ? uint32_t{SPHC_HINT_AMBIGUOUS} : 0u);
  }
}

TEST(LocalizerTracking, AfterAmbiguousFramesAPoseMakesNoTrackSure) {
  for (const uint32_t ambiguous : {0u, 4u}) {
    Walk walk(trackingConfig());
    walk.showBelow(0.5, 4);
    for (uint32_t i = 0; i < ambiguous; ++i) ASSERT_EQ(walk.see(0).hints, uint32_t{SPHC_HINT_AMBIGUOUS});
    walk.showBelow(1, 4);
    const sphc_localizer_result first = walk.see(0), second = walk.see(1);
    ASSERT_EQ(first.outcome, SPHC_OUTCOME_LOCALIZED);
    EXPECT_EQ(first.confidence <= 0.95, ambiguous > 0) << first.confidence;
    EXPECT_EQ(second.state, ambiguous > 0 ? SPHC_STATE_RELOCALIZING : SPHC_STATE_TRACKING);
  }
}

TEST(LocalizerTracking, AmbiguousFramesAreForgottenWithAResetAndTheClock) {
  for (void (Walk::*anew)() : {&Walk::forget, &Walk::setClockBack}) {
    Walk walk(trackingConfig());
    walk.showBelow(0.5, 4);
    for (uint32_t i = 0; i < 4; ++i) ASSERT_EQ(walk.see(0).hints, uint32_t{SPHC_HINT_AMBIGUOUS});
    walk.showBelow(1, 4);
    (walk.*anew)();
    EXPECT_GT(walk.see(0).confidence, 0.95);
    EXPECT_EQ(walk.see(1).state, SPHC_STATE_TRACKING);
  }
}

TEST(LocalizerTracking, ADarkFrameIsOvercome) {
  Walk walk(trackingConfig());
  for (uint32_t viewpoint : {0u, 1u, 2u}) walk.see(viewpoint);
  const sphc_localizer_result dark = walk.see(3, 0, true);
  EXPECT_EQ(dark.outcome, SPHC_OUTCOME_FEW_KEYPOINTS);
  EXPECT_NE(dark.hints & SPHC_HINT_TOO_DARK, 0u);
  EXPECT_EQ(dark.state, SPHC_STATE_LOST);
  EXPECT_EQ(walk.see(3).state, SPHC_STATE_TRACKING);
}

// The pose is right, and odometry wrong: nobody can know that.
TEST(LocalizerTracking, OdometryVetoesAJumpToFewerInliers) {
  Walk walk(trackingConfig());
  walk.useOdometry();
  for (uint32_t viewpoint : {0u, 1u}) walk.see(viewpoint);
  const sphc_localizer_result tracked = walk.see(2);
  ASSERT_EQ(tracked.state, SPHC_STATE_TRACKING);
  walk.keepOdometryBehind(4);
  const sphc_localizer_result jump = walk.see(7);
  ASSERT_LT(jump.inliers, tracked.inliers);
  EXPECT_EQ(jump.outcome, SPHC_OUTCOME_UNCERTAIN);
  EXPECT_EQ(jump.hints, uint32_t{SPHC_HINT_AMBIGUOUS});
  EXPECT_EQ(jump.state, SPHC_STATE_LOST);
  uint32_t tenths = 1;
  while (tenths < 110 && walk.see(7).outcome != SPHC_OUTCOME_LOCALIZED) ++tenths;
  EXPECT_GT(tenths, 50u) << "fewer inliers must wait until less than half of the track's word is left";
  EXPECT_LT(tenths, 100u) << "but not for ever";
}

TEST(LocalizerTracking, OdometryOfAnInverseIsNamedAndLeftOut) {
  Walk walk(trackingConfig());
  walk.useOdometry();
  walk.invertOdometry();
  uint32_t before = 0;
  while (before < 12 && !(walk.see(before).faults & SPHC_FAULT_ODOMETRY_DISAGREES)) ++before;
  EXPECT_GT(before, 2u) << "twice it must move otherwise";
  ASSERT_LT(before, 10u);
  for (uint32_t viewpoint = before + 1; viewpoint < before + 4; ++viewpoint) {
    const sphc_localizer_result result = walk.see(viewpoint);
    EXPECT_EQ(result.outcome, SPHC_OUTCOME_LOCALIZED) << viewpoint;
    EXPECT_EQ(result.faults, uint32_t{SPHC_FAULT_ODOMETRY_DISAGREES}) << viewpoint;
  }
  walk.forget();
  EXPECT_EQ(walk.see(before + 4).faults, 0u);
}

TEST(LocalizerTracking, OdometryThatDisagreedIsForgottenWithTheClockAndTheMap) {
  for (void (Walk::*anew)() : {&Walk::setClockBack, &Walk::takeMapAwayAndGiveItBack}) {
    Walk walk(trackingConfig());
    walk.useOdometry();
    walk.invertOdometry();
    uint32_t viewpoint = 0;
    while (viewpoint < 10 && !(walk.see(viewpoint).faults & SPHC_FAULT_ODOMETRY_DISAGREES)) ++viewpoint;
    ASSERT_LT(viewpoint, 10u);
    (walk.*anew)();
    EXPECT_EQ(walk.see(viewpoint + 1).faults, 0u);
  }
}

TEST(LocalizerTracking, OdometryOfAnotherScaleIsNamedAndVetoesNothing) {
  Walk walk(trackingConfig());
  walk.useOdometry();
  walk.scaleOdometry(3);
  uint32_t before = 0;
  while (before < 30 && !(walk.see(before % 8).faults & SPHC_FAULT_DEPTH_SCALE)) ++before;
  ASSERT_LT(before, 30u);
  for (uint32_t frame = before + 1; frame < before + 60; ++frame) {
    const sphc_localizer_result result = walk.see(frame % 8 < 4 ? frame % 8 : 8 - frame % 8);
    EXPECT_EQ(result.outcome, SPHC_OUTCOME_LOCALIZED) << frame;
    EXPECT_NE(result.state, SPHC_STATE_TRACKING) << frame;
  }
}

// A frame whose depth nobody believes still is a step of odometry.
TEST(LocalizerTracking, OdometryThatJumpsWhileDepthIsWrongIsNoScaleOfDepth) {
  Walk walk(trackingConfig());
  walk.useOdometry();
  for (uint32_t frame = 0; frame < 24; ++frame) walk.see(frame % 8 < 4 ? frame % 8 : 8 - frame % 8);
  walk.shiftOdometry(5);
  walk.scaleDepth(20);
  ASSERT_EQ(walk.see(0).outcome, SPHC_OUTCOME_CONTRADICTION);
  walk.scaleDepth(1);
  for (uint32_t frame = 25; frame < 60; ++frame)
    EXPECT_EQ(walk.see(frame % 8 < 4 ? frame % 8 : 8 - frame % 8).faults, 0u) << frame;
}

// 20 cm farther than expected, where half a tile may be meant.
TEST(LocalizerTracking, AJumpIsFoundInTheWholeMap) {
  Walk walk(trackingConfig());
  for (uint32_t viewpoint : {0u, 1u, 2u, 3u}) walk.see(viewpoint);
  const sphc_localizer_result jump = walk.see(7);
  EXPECT_EQ(jump.outcome, SPHC_OUTCOME_LOCALIZED);
  EXPECT_EQ(jump.events, uint32_t{SPHC_EVENT_JUMPED});
  EXPECT_EQ(jump.guided, 0u);
}

TEST(LocalizerTracking, AJumpThatNoHeadCanMakeIsVetoed) {
  Walk walk(trackingConfig());
  for (uint32_t viewpoint : {0u, 1u, 2u, 3u}) walk.see(viewpoint);
  const sphc_localizer_result jump = walk.see(14);
  EXPECT_EQ(jump.outcome, SPHC_OUTCOME_UNCERTAIN);
  EXPECT_EQ(jump.hints, uint32_t{SPHC_HINT_AMBIGUOUS});
  EXPECT_EQ(walk.see(14).outcome, SPHC_OUTCOME_LOCALIZED) << "in a fifth of a second it can";
}

TEST(LocalizerTracking, ResetForgets) {
  Walk walk(trackingConfig());
  for (uint32_t viewpoint : {0u, 1u, 2u}) walk.see(viewpoint);
  walk.forget();
  const sphc_localizer_result result = walk.see(3);
  EXPECT_EQ(result.state, SPHC_STATE_RELOCALIZING);
  EXPECT_EQ(result.guided, 0u);
}

TEST(LocalizerTracking, SingleModeKnowsNoYesterday) {
  Walk walk(test::sceneConfig());
  for (uint32_t viewpoint : {0u, 1u, 2u}) {
    const sphc_localizer_result result = walk.see(viewpoint);
    EXPECT_EQ(result.state, SPHC_STATE_RELOCALIZING);
    EXPECT_EQ(result.guided, 0u);
  }
}

TEST(LocalizerTracking, FindsTheRoomAndIsHandedOver) {
  Walk walk(trackingConfig(), 0.5, 3);
  for (uint32_t viewpoint : {0u, 1u, 2u}) EXPECT_EQ(walk.see(viewpoint, 2).outcome, SPHC_OUTCOME_LOCALIZED);
  const sphc_localizer_result moved = walk.see(1, 1);  // through a door
  EXPECT_EQ(moved.outcome, SPHC_OUTCOME_LOCALIZED);
  EXPECT_EQ(moved.state, SPHC_STATE_LOST);  // one frame alone is not yet trusted
  EXPECT_EQ(walk.see(2, 1).state, SPHC_STATE_TRACKING);
  EXPECT_EQ(walk.see(3, 1).guided, 1u);
}

// A frame of a room of which there is no map: several maps are looked into, and what is told is of one of them.
TEST(LocalizerTracking, MatchesOfAFailureAreOfTheMapThatItNames) {
  sphc_localizer_config config = trackingConfig();
  Walk walk(config, 0.5, 3);
  walk.session().setParameter(SPHC_PARAMETER_MAX_RATIO, 1);  // everything matches something
  uint32_t looked_at = 0;
  for (uint32_t viewpoint : {0u, 1u, 2u, 3u}) {
    const sphc_localizer_result result = walk.see(viewpoint, 7);
    EXPECT_NE(result.outcome, SPHC_OUTCOME_LOCALIZED);
    uint32_t matched = 0;
    for (const sphc_localizer_observation &o : walk.observations()) {
      if (!(o.flags & SPHC_OBSERVATION_MATCHED)) continue;
      EXPECT_LT(o.point_index, walk.pointsOf(result.map_id));
      ++matched;
    }
    EXPECT_EQ(matched, result.matches);
    EXPECT_LE(result.inliers, result.matches);
    looked_at += result.matches;
  }
  EXPECT_GT(looked_at, 0u);
}

// Frames that show too little one by one.
TEST(LocalizerTracking, OdometryPutsPoorFramesTogether) {
  sphc_localizer_config config = trackingConfig();
  config.max_keypoints = 80;
  constexpr double kEta = 0.2;
  Walk alone(config, kEta), together(config, kEta);
  together.useOdometry();
  uint32_t found_alone = 0, found_together = 0, most_frames = 0;
  for (uint32_t viewpoint = 0; viewpoint < 10; ++viewpoint) {
    found_alone += alone.see(viewpoint).outcome == SPHC_OUTCOME_LOCALIZED;
    const sphc_localizer_result result = together.see(viewpoint);
    found_together += result.outcome == SPHC_OUTCOME_LOCALIZED;
    if (result.outcome == SPHC_OUTCOME_LOCALIZED) most_frames = std::max(most_frames, result.frames);
  }
  EXPECT_GT(found_together, found_alone);
  EXPECT_GT(most_frames, 1u);
}

// What was seen before names points of the map that was there.
TEST(LocalizerTracking, FramesOfAMapThatIsReplacedAreNotPutTogether) {
  sphc_localizer_config config = trackingConfig();
  config.max_keypoints = 80;
  for (const bool is_replaced : {false, true}) {
    Walk walk(config, 0.2);
    walk.useOdometry();
    for (uint32_t viewpoint : {0u, 1u, 2u, 3u}) walk.see(viewpoint);
    ASSERT_NE(walk.see(4).outcome, SPHC_OUTCOME_LOCALIZED) << "else there is nothing to put together";
    if (is_replaced) walk.replaceMap();
    EXPECT_EQ(walk.see(5).frames, is_replaced ? 1u : 2u);
  }
}

// A lens that zooms or refocuses: its calibration holds before and after.
TEST(LocalizerTracking, AFocalLengthThatChangesIsNamedWhileItIsAnother) {
  Walk walk(trackingConfig());
  for (uint32_t viewpoint : {3u, 4u, 5u}) EXPECT_EQ(walk.see(viewpoint).faults, 0u) << viewpoint;
  walk.zoom(1 / 0.85);
  for (uint32_t viewpoint : {5u, 6u, 5u}) {
    const sphc_localizer_result result = walk.see(viewpoint);
    EXPECT_NE(result.faults & (SPHC_FAULT_FOCAL_DISAGREES | SPHC_FAULT_DISTANCES_DISAGREE), 0u) << viewpoint;
    EXPECT_LE(result.confidence, 0.5) << viewpoint;
    EXPECT_NE(result.state, SPHC_STATE_TRACKING) << viewpoint;
  }
  walk.zoom(1);
  for (uint32_t viewpoint : {5u, 6u, 5u}) {
    const sphc_localizer_result result = walk.see(viewpoint);
    EXPECT_EQ(result.outcome, SPHC_OUTCOME_LOCALIZED) << viewpoint;
    EXPECT_EQ(result.faults, 0u) << viewpoint;
  }
}

// Frames whose depth is taken so many steps before colour, while the camera moves.
struct DepthBefore {
  double first_error_m = 0, error_m = 0;  // the other is the mean from that frame on from which the way is known
  sphc_localizer_result first = {}, last = {};

  // Odometry is exact, and says that it errs by `sigma` rad and m a step; 0: none is given.
  DepthBefore(double steps, bool times_are_told, double sigma = 1e-3) {
    sphc_localizer_config config = trackingConfig();
    config.depth_offset_sigma_m = 0.02;  // so that something can be learnt
    config.depth_slope_sigma = 0.01;
    test::Session session(config);
    const auto known = static_cast<uint32_t>(std::ceil(steps));
    constexpr uint32_t kFrames = 8;
    for (uint32_t i = 0; i < kFrames + known; ++i) {
      const auto made = test::sceneFrame(config, i);
      made->images.depth_mm =
          test::renderScene(config.rig.color_camera, config.rig.depth_camera, test::sceneViewpoint(i - steps),
                            rigidFromC(config.rig.color_from_depth))
              .depth_mm;
      sphc_localizer_frame frame = made->frame;
      frame.depth.data = made->images.depth_mm.data();
      frame.color_time_ns = frame.depth_time_ns = (i + 1) * kStepNs;
      if (times_are_told) frame.depth_time_ns -= static_cast<int64_t>(steps * kStepNs);
      sphc_localizer_prior prior = {};
      prior.struct_size = sizeof prior;
      prior.flags = SPHC_PRIOR_ODOMETRY;
      prior.odometry_from_camera = rigidToC(test::sceneViewpoint(i).inverse());
      prior.odometry_rotation_sigma_rad = prior.odometry_translation_sigma_m = sigma;
      frame.prior = sigma > 0 ? &prior : nullptr;
      last = {};
      EXPECT_EQ(session.process(frame, &last), SPHC_OK) << i;
      if (i == 0) first = last, first_error_m = session.errorM(first, 0);
      if (i >= known) error_m += session.errorM(last, i) / kFrames;
    }
  }
};

TEST(LocalizerTracking, OdometryTakesDepthToTheTimeOfTheColourImage) {
  for (const double steps : {0.3, 2.4})
    EXPECT_LT(DepthBefore(steps, true).error_m, 0.5 * DepthBefore(steps, false).error_m) << steps;
}

TEST(LocalizerTracking, APoseOfImagesThatNothingBringsTogetherIsNotSure) {
  const DepthBefore told(2.4, true), hidden(2.4, false);
  EXPECT_GT(hidden.first_error_m, 0.1);
  EXPECT_GT(hidden.first.confidence, 0.95f) << "else this test says nothing";
  EXPECT_LT(told.first.confidence, 0.5f);
  EXPECT_LT(told.first_error_m, 5 * std::sqrt(told.first.covariance[21]));
  EXPECT_GT(told.last.confidence, 0.95f) << "the way is known by now";
  EXPECT_EQ(told.last.state, SPHC_STATE_TRACKING);
  EXPECT_LT(std::abs(told.last.depth.offset_m), 0.02);
}

TEST(LocalizerTracking, WhatOdometrySaysOfItsErrorsIsBelieved) {
  const DepthBefore exact(2.4, true, 1e-4), coarse(2.4, true, 1e-2);
  EXPECT_LT(exact.last.covariance[21], 1e-4);
  EXPECT_NEAR(coarse.last.covariance[21] - exact.last.covariance[21], 2 * 2.4 * 1e-4, 2e-5);
  EXPECT_NEAR(coarse.last.covariance[0] - exact.last.covariance[0], 2.4 * 1e-4, 1e-5);
  EXPECT_LT(coarse.last.confidence, 0.95f);
}

// Two cameras without a common trigger: less exact, but the place is no other one.
TEST(LocalizerTracking, ImagesThatAreHardlyApartAreTracked) {
  const DepthBefore none(0, true, 0), hardly(0.4, true, 0), apart(0.6, true, 0);
  EXPECT_EQ(none.last.state, SPHC_STATE_TRACKING);
  EXPECT_EQ(hardly.last.state, SPHC_STATE_TRACKING);
  EXPECT_LT(hardly.last.confidence, none.last.confidence);
  EXPECT_NEAR(hardly.first.covariance[21] - none.first.covariance[21], 0.014 * 0.014, 2e-5);
  EXPECT_EQ(apart.last.state, SPHC_STATE_RELOCALIZING);
  EXPECT_LT(none.last.depth.offset_sigma_m, none.first.depth.offset_sigma_m);
  EXPECT_EQ(apart.last.depth.offset_sigma_m, apart.first.depth.offset_sigma_m) << "it teaches nothing";
}

// Blocks in depth of which the image shows nothing; a dark image shows noise.
Faults faultsOfStrangeDepth(bool dark, bool forgets = false) {
  const sphc_localizer_config config = trackingConfig();
  test::Session session(config);
  Random random(7);
  Faults faults = 0;
  for (uint32_t i = 0; i < 12; ++i) {
    const auto made = test::sceneFrame(config, i % 4);
    if (dark)
      for (uint8_t &level : made->images.gray) level = static_cast<uint8_t>(20 + random.below(16));
    const uint32_t width = made->frame.depth.width;
    for (uint32_t at = 0; at < made->images.depth_mm.size(); ++at)
      made->images.depth_mm[at] = ((at % width + 3 * i) / 20 + at / width / 20) % 2 ? 2000 : 3000;
    sphc_localizer_frame frame = made->frame;
    frame.color_time_ns = frame.depth_time_ns = (i + 1) * 10 * kStepNs;
    sphc_localizer_result result = {};
    session.process(frame, &result);
    if (forgets) sphc_localizer_reset(session.localizer());
    faults |= result.faults;
  }
  return faults;
}

TEST(LocalizerTracking, DepthIsNotSaidToDisagreeWithAnImageOfNoise) {
  EXPECT_NE(faultsOfStrangeDepth(false) & SPHC_FAULT_DEPTH_COLOR_DISAGREE, 0u);
  EXPECT_EQ(faultsOfStrangeDepth(true) & SPHC_FAULT_DEPTH_COLOR_DISAGREE, 0u);
}

TEST(LocalizerTracking, DoubtsOfDepthAreForgottenWithAReset) {
  EXPECT_EQ(faultsOfStrangeDepth(false, true) & SPHC_FAULT_DEPTH_COLOR_DISAGREE, 0u);
}

// A common scale of all depths moves every point of the map by as much, and the pose with them.
TEST(LocalizerTracking, PointsThatLieElsewhereThanTheyDidTakeThePoseAway) {
  Walk walk(trackingConfig());
  for (uint32_t viewpoint : {0u, 1u, 2u}) EXPECT_EQ(walk.see(viewpoint).faults, 0u) << viewpoint;
  walk.scaleDepth(1.2);
  for (uint32_t frame = 0; frame < 10; ++frame) {
    const sphc_localizer_result result = walk.see(3 + frame % 2);
    EXPECT_EQ(result.outcome, SPHC_OUTCOME_CONTRADICTION) << frame;
    EXPECT_EQ(result.faults, SPHC_FAULT_DISTANCES_DISAGREE) << frame;
  }
  EXPECT_EQ(walk.see(3).outcome, SPHC_OUTCOME_LOCALIZED)
      << "after a second the earlier frames may be the wrong ones";
  EXPECT_EQ(walk.see(4).outcome, SPHC_OUTCOME_LOCALIZED);
  walk.scaleDepth(1);
  EXPECT_EQ(walk.see(3).outcome, SPHC_OUTCOME_CONTRADICTION) << "what is kept now is of the later ones";
}

TEST(LocalizerTracking, WhatPointsSaidIsForgottenWithAResetTheClockAndTheMap) {
  for (void (Walk::*anew)() :
       {&Walk::forget, &Walk::setClockBack, &Walk::replaceMap, &Walk::takeMapAwayAndGiveItBack}) {
    Walk walk(trackingConfig());
    for (uint32_t viewpoint : {0u, 1u, 2u}) walk.see(viewpoint);
    walk.scaleDepth(1.2);
    EXPECT_EQ(walk.see(3).outcome, SPHC_OUTCOME_CONTRADICTION);
    (walk.*anew)();
    EXPECT_EQ(walk.see(4).outcome, SPHC_OUTCOME_LOCALIZED);
  }
}

TEST(LocalizerTracking, WhatPointsSaidIsForgottenInAnotherMap) {
  Walk walk(trackingConfig(), 0.5, 2);
  for (uint32_t viewpoint : {0u, 1u, 2u}) walk.see(viewpoint);
  EXPECT_EQ(walk.see(0, 1).outcome, SPHC_OUTCOME_LOCALIZED);
  walk.scaleDepth(1.2);
  EXPECT_EQ(walk.see(3).outcome, SPHC_OUTCOME_LOCALIZED);
}

}  // namespace
}  // namespace sphc
