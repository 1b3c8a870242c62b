#include "runtime/capi/translate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/arena_memory.h"
#include "tests/support/session.h"

namespace sphc {
namespace {

TEST(TranslateConfig, EveryNumberArrives) {
  sphc_localizer_config config = test::sceneConfig();
  config.max_keypoints = 401;
  config.max_maps = 7;
  config.seed = 0x123456789abcdefull;
  config.pixel_sigma_px = 1.25;
  config.map_sigma_m = 0.0075;
  const LocalizerConfig own = localizerConfigFrom(config);
  EXPECT_EQ(own.max_keypoints, 401u);
  EXPECT_EQ(own.max_maps, 7u);
  EXPECT_EQ(own.seed, 0x123456789abcdefull);
  EXPECT_EQ(own.pixel_sigma_px, 1.25);
  EXPECT_EQ(own.map_sigma_m, 0.0075);
}

TEST(TranslateConfig, TheRigArrives) {
  const LocalizerConfig own = localizerConfigFrom(test::sceneConfig());
  EXPECT_EQ(own.color_camera.width(), 320);
  EXPECT_EQ(own.color_camera.height(), 240);
  EXPECT_EQ(own.depth[0].camera.width(), 200);
  EXPECT_EQ(own.depth[0].camera.height(), 160);
  EXPECT_EQ(own.depth[0].color_from_depth.translation_m, Vector3(0.04, 0, 0));
}

TEST(TranslateConfig, ModesAndTheClock) {
  sphc_localizer_config config = test::sceneConfig();
  config.mode = SPHC_MODE_SINGLE;
  EXPECT_FALSE(localizerConfigFrom(config).tracks);
  config.mode = SPHC_MODE_TRACKING;
  EXPECT_TRUE(localizerConfigFrom(config).tracks);
  EXPECT_EQ(localizerConfigFrom(config).clock.now(), 0);
  int64_t now = 41;
  config.clock = [](void *user) { return ++*static_cast<int64_t *>(user); };
  config.clock_user = &now;
  EXPECT_EQ(localizerConfigFrom(config).clock.now(), 42);
}

TEST(TranslateConfig, TheDepthSensor) {
  sphc_localizer_config config = test::sceneConfig();
  config.depth_min_m = 0.5;
  config.depth_max_m = 8;
  config.depth_sigma_m = 0.003;
  config.depth_sigma_per_m2 = 0.004;
  config.depth_offset_sigma_m = 0.02;
  config.depth_slope_sigma = 0.03;
  config.depth_mid_m = 0;
  const LocalizerConfig own = localizerConfigFrom(config);
  EXPECT_EQ(own.depth[0].sensor.min_m, 0.5);
  EXPECT_EQ(own.depth[0].sensor.max_m, 8);
  EXPECT_EQ(own.depth[0].sensor.sigma_m, 0.003);
  EXPECT_EQ(own.depth[0].sensor.sigma_per_m2, 0.004);
  EXPECT_DOUBLE_EQ(own.depth_prior.covariance(0, 0), 0.02 * 0.02);
  EXPECT_DOUBLE_EQ(own.depth_prior.covariance(1, 1), 0.03 * 0.03);
  EXPECT_EQ(own.depth_prior.covariance(0, 1), 0);
  EXPECT_DOUBLE_EQ(own.depth_prior.mid_m, 2);  // the geometric mean of 0.5 and 8
  config.depth_mid_m = 1.5;
  EXPECT_EQ(localizerConfigFrom(config).depth_prior.mid_m, 1.5);
}

TEST(TranslateFrame, BorrowsItsImages) {
  uint8_t color[6 * 4 * 2] = {};
  uint16_t depth[5 * 3] = {};
  sphc_localizer_frame frame = {};
  frame.color_time_ns = 100;
  frame.depth_time_ns = 103;
  frame.deadline_us = 4000000000u;
  frame.color = {color, 4, 2, 16, SPHC_FORMAT_BGR8};
  frame.depth = {depth, 4, 3, 10, SPHC_FORMAT_DEPTH16};
  FrameInput own = frameFrom(frame, MapSet());
  EXPECT_EQ(own.color_time_ns, 100);
  EXPECT_EQ(own.depth[0].time_ns, 103);
  EXPECT_EQ(own.time_limit_ns, 4000000000000);
  EXPECT_EQ(own.color.bytes.data, color);
  EXPECT_EQ(own.color.bytes.width, 4);
  EXPECT_EQ(own.color.bytes.height, 2);
  EXPECT_EQ(own.color.bytes.stride, 16);
  EXPECT_EQ(own.color.layout.kind, LumaLayout::kBgr);
  EXPECT_EQ(own.depth[0].depth.data, reinterpret_cast<const uint8_t *>(depth));
  EXPECT_EQ(own.depth[0].depth.width, 4);
  EXPECT_EQ(own.depth[0].depth.height, 3);
  EXPECT_EQ(own.depth[0].depth.stride, 10);
  EXPECT_EQ(own.depth[0].amplitude.bytes.data, nullptr);
  EXPECT_FALSE(own.known.prior.has_pose || own.known.prior.has_up || own.known.has_odometry);
  frame.color.format = SPHC_FORMAT_RGB8;
  EXPECT_EQ(frameFrom(frame, MapSet()).color.layout.kind, LumaLayout::kRgb);
  frame.color.format = SPHC_FORMAT_GRAY8;
  EXPECT_EQ(frameFrom(frame, MapSet()).color.layout.kind, LumaLayout::kPlane);
  const uint8_t light[4 * 3 * 2] = {};
  frame.amplitude = {light, 4, 3, 8, SPHC_FORMAT_GRAY12};
  EXPECT_EQ(frameFrom(frame, MapSet()).depth[0].amplitude.bytes.data, light);
  EXPECT_EQ(frameFrom(frame, MapSet()).depth[0].amplitude.pixel_bytes, 2);
}

class TranslatePrior : public testing::Test {
 protected:
  TranslatePrior() {
    prior_.struct_size = sizeof prior_;
    prior_.map_id = 3;
    prior_.camera_from_map = {{0, 1, 0, 0}, {1, 2, 3}};  // half a turn about x
    prior_.rotation_sigma_rad = 0.1;
    prior_.translation_sigma_m = 0.2;
    prior_.up_camera[1] = -2;
    prior_.up_map[2] = 4;
    prior_.up_sigma_rad = 0.3;
    prior_.odometry_from_camera = {{1, 0, 0, 0}, {4, 5, 6}};
    prior_.odometry_rotation_sigma_rad = 0.4;
    prior_.odometry_translation_sigma_m = 0.5;
  }
  Known known(uint32_t flags) {
    prior_.flags = flags;
    sphc_localizer_frame frame = {};
    frame.prior = &prior_;
    MapSet maps;
    test::ArenaMemory memory([&](Arena &arena, bool real) { MapSet::layout(2, arena, real ? &maps : nullptr); });
    maps.set(9, MapView());
    maps.set(3, MapView());
    return frameFrom(frame, maps).known;
  }
  sphc_localizer_prior prior_ = {};
};

TEST_F(TranslatePrior, APose) {
  const Known own = known(SPHC_PRIOR_POSE);
  EXPECT_TRUE(own.prior.has_pose);
  EXPECT_EQ(own.map, 1u);  // its slot
  EXPECT_LT((own.prior.camera_from_map * Vector3(0, 1, 0) - Vector3(1, 1, 3)).norm(), 1e-12);
  EXPECT_EQ(own.prior.rotation_sigma_rad, 0.1);
  EXPECT_EQ(own.prior.translation_sigma_m, 0.2);
  EXPECT_FALSE(own.prior.has_up);
  EXPECT_FALSE(own.has_odometry);
}

TEST_F(TranslatePrior, AVerticalOfAnyLength) {
  const Known own = known(SPHC_PRIOR_UP);
  EXPECT_TRUE(own.prior.has_up);
  EXPECT_LT((own.prior.up_camera - Vector3(0, -1, 0)).norm(), 1e-12);
  EXPECT_LT((own.prior.up_map - Vector3(0, 0, 1)).norm(), 1e-12);
  EXPECT_EQ(own.prior.up_sigma_rad, 0.3);
  EXPECT_FALSE(own.prior.has_pose);
}

TEST_F(TranslatePrior, Odometry) {
  const Known own = known(SPHC_PRIOR_ODOMETRY);
  EXPECT_TRUE(own.has_odometry);
  EXPECT_EQ(own.odometry.odometry_from_camera.translation_m, Vector3(4, 5, 6));
  EXPECT_EQ(own.odometry.rotation_sigma_rad, 0.4);
  EXPECT_EQ(own.odometry.translation_sigma_m, 0.5);
  EXPECT_FALSE(own.prior.has_pose || own.prior.has_up);
}

TEST(TranslateBack, OutcomesAndStatesByName) {
  EXPECT_EQ(outcomeFrom(Outcome::kLocalized), SPHC_OUTCOME_LOCALIZED);
  EXPECT_EQ(outcomeFrom(Outcome::kFewKeypoints), SPHC_OUTCOME_FEW_KEYPOINTS);
  EXPECT_EQ(outcomeFrom(Outcome::kFewDepths), SPHC_OUTCOME_FEW_DEPTHS);
  EXPECT_EQ(outcomeFrom(Outcome::kFewMatches), SPHC_OUTCOME_FEW_MATCHES);
  EXPECT_EQ(outcomeFrom(Outcome::kNoConsensus), SPHC_OUTCOME_NO_CONSENSUS);
  EXPECT_EQ(outcomeFrom(Outcome::kUncertain), SPHC_OUTCOME_UNCERTAIN);
  EXPECT_EQ(outcomeFrom(Outcome::kDeadline), SPHC_OUTCOME_DEADLINE);
  EXPECT_EQ(stateFrom(TrackingState::kRelocalizing), SPHC_STATE_RELOCALIZING);
  EXPECT_EQ(stateFrom(TrackingState::kTracking), SPHC_STATE_TRACKING);
  EXPECT_EQ(stateFrom(TrackingState::kLost), SPHC_STATE_LOST);
}

TEST(TranslateBack, Observations) {
  const sphc_localizer_observation o = observationFrom({1, 2, 3, 4, 5, 6, true, false, true});
  EXPECT_EQ(o.x_px, 1);
  EXPECT_EQ(o.y_px, 2);
  EXPECT_EQ(o.scale_px, 3);
  EXPECT_EQ(o.depth_m, 4);
  EXPECT_EQ(o.point_index, 5u);
  EXPECT_EQ(o.flags, uint32_t{SPHC_OBSERVATION_LIFTED | SPHC_OBSERVATION_INLIER});
  EXPECT_EQ(observationFrom({1, 2, 3, 4, 5, 6, false, true, false}).flags, uint32_t{SPHC_OBSERVATION_MATCHED});
}

LocalizerResult answerOf(Outcome outcome) {
  LocalizerResult answer;
  answer.outcome = outcome;
  answer.state = TrackingState::kLost;
  answer.keypoints = 50;
  answer.lifted = 40;
  answer.matches = 30;
  answer.inliers = 20;
  answer.samples = 10;
  answer.cuts = kCutMatches | kCutVerification;
  answer.faults = kDepthScale;
  answer.hints = kTooDark | kAmbiguous;
  answer.map_id = 6;
  answer.frames = 7;
  answer.guided = true;
  answer.camera_from_map.translation_m = Vector3(1, 2, 3);
  for (int i = 0; i < 36; ++i) answer.covariance(i / 6, i % 6) = i;
  answer.confidence = 0.9;
  answer.depth.mid_m = 2;
  answer.depth.mean = Vector2(0.01, 0.02);
  answer.depth.covariance << 0.0009, 0, 0, 0.0016;
  answer.depth.noise_scale = 1.5;
  answer.jump = {kJumped, 0.25, 0.125};
  answer.times = {1999, 2000, 3000000, UINT64_MAX};
  return answer;
}

sphc_localizer_result resultOf(Outcome outcome) {
  sphc_localizer_frame frame = {};
  frame.sequence = 77;
  frame.color_time_ns = 1234;
  return resultFrom(answerOf(outcome), frame);
}

TEST(TranslateBack, EveryNumberOfAResult) {
  const sphc_localizer_result result = resultOf(Outcome::kLocalized);
  EXPECT_EQ(result.struct_size, sizeof(sphc_localizer_result));
  EXPECT_EQ(result.sequence, 77u);
  EXPECT_EQ(result.time_ns, 1234);
  EXPECT_EQ(result.outcome, SPHC_OUTCOME_LOCALIZED);
  EXPECT_EQ(result.state, SPHC_STATE_LOST);
  EXPECT_EQ(result.keypoints, 50u);
  EXPECT_EQ(result.lifted, 40u);
  EXPECT_EQ(result.matches, 30u);
  EXPECT_EQ(result.inliers, 20u);
  EXPECT_EQ(result.iterations, 10u);
  EXPECT_EQ(result.cuts, uint32_t{SPHC_CUT_MATCHES | SPHC_CUT_VERIFICATION});
  EXPECT_EQ(result.faults, uint32_t{SPHC_FAULT_DEPTH_SCALE});
  EXPECT_EQ(result.hints, uint32_t{SPHC_HINT_TOO_DARK | SPHC_HINT_AMBIGUOUS});
  EXPECT_EQ(result.map_id, 6u);
  EXPECT_EQ(result.frames, 7u);
  EXPECT_EQ(result.guided, 1u);
  EXPECT_EQ(result.confidence, 0.9);
  EXPECT_EQ(result.camera_from_map.q_wxyz[0], 1);
  EXPECT_EQ(result.camera_from_map.t_m[2], 3);
  for (int i = 0; i < 36; ++i) EXPECT_EQ(result.covariance[i], i);
  EXPECT_EQ(result.depth.mid_m, 2);
  EXPECT_EQ(result.depth.offset_m, 0.01);
  EXPECT_EQ(result.depth.slope, 0.02);
  EXPECT_NEAR(result.depth.offset_sigma_m, 0.03, 1e-15);
  EXPECT_NEAR(result.depth.slope_sigma, 0.04, 1e-15);
  EXPECT_EQ(result.depth.noise_scale, 1.5);
  EXPECT_EQ(result.events, uint32_t{SPHC_EVENT_JUMPED});
  EXPECT_EQ(result.jump_m, 0.25);
  EXPECT_EQ(result.jump_rad, 0.125);
}

TEST(TranslateBack, EveryNumberOfAPrediction) {
  MovedPose moved;
  moved.pose_time_ns = 55;
  moved.camera_from_map.translation_m = Vector3(1, 2, 3);
  for (int i = 0; i < 36; ++i) moved.covariance(i / 6, i % 6) = i;
  moved.velocity_in_map_m_s = Vector3(4, 5, 6);
  moved.angular_velocity_in_map_rad_s = Vector3(7, 8, 9);
  moved.velocity_sigma_m_s = 10;
  moved.angular_velocity_sigma_rad_s = 11;
  const sphc_localizer_prediction prediction = predictionFrom(moved, 12);
  EXPECT_EQ(prediction.map_id, 12u);
  EXPECT_EQ(prediction.pose_time_ns, 55);
  EXPECT_EQ(prediction.camera_from_map.q_wxyz[0], 1);
  for (int i = 0; i < 36; ++i) EXPECT_EQ(prediction.covariance[i], i);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(prediction.camera_from_map.t_m[i], 1 + i);
    EXPECT_EQ(prediction.velocity_in_map_m_s[i], 4 + i);
    EXPECT_EQ(prediction.angular_velocity_in_map_rad_s[i], 7 + i);
  }
  EXPECT_EQ(prediction.velocity_sigma_m_s, 10);
  EXPECT_EQ(prediction.angular_velocity_sigma_rad_s, 11);
}

TEST(TranslateBack, TimesAreWholeMicrosecondsAndNeverWrapAround) {
  const sphc_localizer_result result = resultOf(Outcome::kLocalized);
  EXPECT_EQ(result.features_us, 1u);
  EXPECT_EQ(result.align_us, 2u);
  EXPECT_EQ(result.match_us, 3000u);
  EXPECT_EQ(result.pose_us, UINT32_MAX);
}

// A pose that is not believed is not told.
TEST(TranslateBack, WithoutAPoseThereIsTheIdentity) {
  const sphc_localizer_result result = resultOf(Outcome::kUncertain);
  EXPECT_EQ(result.outcome, SPHC_OUTCOME_UNCERTAIN);
  EXPECT_EQ(result.camera_from_map.q_wxyz[0], 1);
  for (double t : result.camera_from_map.t_m) EXPECT_EQ(t, 0);
}

}  // namespace
}  // namespace sphc
