// What a caller may tell the pose stage through the C interface: priors, deadline, depth bias.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "tests/capi/bytes.h"
#include "tests/support/session.h"

namespace {

using sphc::test::expectMentions;
using sphc::test::Session;

class CInterfacePoseOptions : public testing::Test {
 protected:
  sphc_localizer_result localize(Session *session, uint32_t viewpoint,
                                 const sphc_localizer_prior *prior = nullptr) {
    const auto made = sphc::test::sceneFrame(config_, viewpoint);
    sphc_localizer_frame frame = made->frame;
    frame.prior = prior;
    frame.deadline_us = deadline_us_;
    sphc_localizer_result result;
    std::memset(&result, 0, sizeof result);
    status_ = session->process(frame, &result);
    return result;
  }
  void expectConfigRefused(const char *words) {
    sphc_memory memory;
    sphc_message message = {};
    EXPECT_EQ(sphc_localizer_memory(&config_, &memory, &message), SPHC_E_ARGUMENT);
    expectMentions(message.text, words);
  }

  sphc_localizer_config config_ = sphc::test::sceneConfig();
  sphc_status status_ = SPHC_OK;
  uint32_t deadline_us_ = 0;
};

sphc_localizer_prior posePrior(const sphc_rigid &camera_from_map) {
  sphc_localizer_prior prior = {};
  prior.struct_size = sizeof prior;
  prior.flags = SPHC_PRIOR_POSE;
  prior.camera_from_map = camera_from_map;
  prior.rotation_sigma_rad = 0.02;
  prior.translation_sigma_m = 0.05;
  return prior;
}

// Its directions are zero.
sphc_localizer_prior upPrior() {
  sphc_localizer_prior prior = {};
  prior.struct_size = sizeof prior;
  prior.flags = SPHC_PRIOR_UP;
  prior.up_sigma_rad = 0.01;
  return prior;
}

double distanceM(const sphc_rigid &a, const sphc_rigid &b) {
  return std::hypot(a.t_m[0] - b.t_m[0], a.t_m[1] - b.t_m[1], a.t_m[2] - b.t_m[2]);
}

TEST_F(CInterfacePoseOptions, ARightPosePriorNeedsNoSamples) {
  Session session(config_);
  const sphc_localizer_result cold = localize(&session, 1);
  ASSERT_EQ(status_, SPHC_OK);
  EXPECT_GT(cold.iterations, 0u);
  const sphc_localizer_prior prior = posePrior(cold.camera_from_map);
  const sphc_localizer_result warm = localize(&session, 1, &prior);
  ASSERT_EQ(status_, SPHC_OK);
  EXPECT_EQ(warm.iterations, 0u);
  EXPECT_LT(distanceM(warm.camera_from_map, cold.camera_from_map), 0.005);
}

TEST_F(CInterfacePoseOptions, AWrongPosePriorCostsTimeNotTheAnswer) {
  Session session(config_);
  const sphc_localizer_result cold = localize(&session, 1);
  sphc_localizer_prior prior = posePrior(cold.camera_from_map);
  prior.camera_from_map.t_m[0] += 2;
  const sphc_localizer_result warm = localize(&session, 1, &prior);
  ASSERT_EQ(status_, SPHC_OK);
  EXPECT_LT(distanceM(warm.camera_from_map, cold.camera_from_map), 0.005);
}

TEST_F(CInterfacePoseOptions, APoseElsewhereThanItsPriorSaysIsFoundInTheWholeMap) {
  Session session(config_);
  const sphc_localizer_result cold = localize(&session, 1);
  sphc_localizer_prior prior = posePrior(cold.camera_from_map);
  prior.rotation_sigma_rad = 0.05;  // so it is looked for 8.6 degrees around
  prior.translation_sigma_m = 0.001;
  prior.camera_from_map.t_m[2] += 0.14;  // along the view, so directions hardly differ
  EXPECT_TRUE(localize(&session, 1, &prior).guided);
  prior.camera_from_map.t_m[2] += 0.04;
  const sphc_localizer_result elsewhere = localize(&session, 1, &prior);
  ASSERT_EQ(elsewhere.outcome, SPHC_OUTCOME_LOCALIZED);
  EXPECT_FALSE(elsewhere.guided);
  EXPECT_LT(distanceM(elsewhere.camera_from_map, cold.camera_from_map), 0.005);
}

TEST_F(CInterfacePoseOptions, TheVerticalHelps) {
  Session session(config_);
  const sphc_localizer_result cold = localize(&session, 1);
  sphc_localizer_prior prior = upPrior();
  prior.up_map[1] = 3;  // any length
  const double w = cold.camera_from_map.q_wxyz[0], x = cold.camera_from_map.q_wxyz[1];
  const double y = cold.camera_from_map.q_wxyz[2], z = cold.camera_from_map.q_wxyz[3];
  prior.up_camera[0] = 2 * (x * y - w * z);  // R (0, 1, 0)
  prior.up_camera[1] = 1 - 2 * (x * x + z * z);
  prior.up_camera[2] = 2 * (y * z + w * x);
  const sphc_localizer_result upright = localize(&session, 1, &prior);
  ASSERT_EQ(status_, SPHC_OK);
  EXPECT_LE(upright.iterations, cold.iterations);
  EXPECT_LT(distanceM(upright.camera_from_map, cold.camera_from_map), 0.005);
}

// Of other axes, it leads to no pose; the frame is looked at without it.
TEST_F(CInterfacePoseOptions, AVerticalOfOtherAxesIsNamed) {
  Session session(config_);
  const sphc_localizer_result cold = localize(&session, 1);
  sphc_localizer_prior prior = upPrior();
  prior.up_camera[2] = prior.up_map[1] = 1;  // along the view, and the vertical of the map is along y
  const sphc_localizer_result found = localize(&session, 1, &prior);
  ASSERT_EQ(found.outcome, SPHC_OUTCOME_LOCALIZED);
  EXPECT_EQ(found.faults & SPHC_FAULT_VERTICAL_DISAGREES, uint32_t{SPHC_FAULT_VERTICAL_DISAGREES});
  EXPECT_LT(distanceM(found.camera_from_map, cold.camera_from_map), 0.005);
}

TEST_F(CInterfacePoseOptions, BadPriorsAreRefused) {
  Session session(config_);
  const sphc_localizer_prior good = posePrior(localize(&session, 1).camera_from_map);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto expectRefused = [&](const sphc_localizer_prior &prior, sphc_status expected, const char *words) {
    localize(&session, 1, &prior);
    EXPECT_EQ(status_, expected) << words;
    expectMentions(sphc_localizer_message(session.localizer()), words);
  };
  sphc_localizer_prior prior = good;
  prior.struct_size = 8;
  expectRefused(prior, SPHC_E_STRUCT_SIZE, "prior.struct_size");
  prior = good;
  prior.flags = 8;
  expectRefused(prior, SPHC_E_UNSUPPORTED, "prior.flags");
  prior = good;
  prior.camera_from_map.t_m[2] = nan;
  expectRefused(prior, SPHC_E_ARGUMENT, "prior.camera_from_map.t_m[2] is nan");
  prior = good;
  prior.translation_sigma_m = 0;
  expectRefused(prior, SPHC_E_ARGUMENT, "prior.translation_sigma_m");
  prior = good;
  prior.rotation_sigma_rad = nan;
  expectRefused(prior, SPHC_E_ARGUMENT, "prior.rotation_sigma_rad");
  prior = good;
  prior.flags = SPHC_PRIOR_UP;
  expectRefused(prior, SPHC_E_ARGUMENT, "prior.up_camera is (0, 0, 0)");
  prior.up_camera[1] = prior.up_map[1] = 1;
  prior.up_map[2] = 1e300;
  expectRefused(prior, SPHC_E_ARGUMENT, "prior.up_map is (0, 1, 1e18+)");
  prior.up_map[2] = 1.001 * SPHC_UP_MAX_LENGTH;
  expectRefused(prior, SPHC_E_ARGUMENT, "prior.up_map is (0, 1, 1001000)");
  prior = good;
  prior.flags = SPHC_PRIOR_ODOMETRY;
  prior.odometry_from_camera = good.camera_from_map;
  prior.odometry_rotation_sigma_rad = 1.1;
  prior.odometry_translation_sigma_m = 0.01;
  expectRefused(prior, SPHC_E_ARGUMENT, "prior.odometry_rotation_sigma_rad");
  prior.odometry_rotation_sigma_rad = 0.01;
  prior.odometry_translation_sigma_m = 0;
  expectRefused(prior, SPHC_E_ARGUMENT, "prior.odometry_translation_sigma_m");
  localize(&session, 1, &good);
  EXPECT_EQ(status_, SPHC_OK);  // and it goes on
}

TEST_F(CInterfacePoseOptions, ADeadlineNeedsAClock) {
  Session session(config_);
  deadline_us_ = 1000;
  localize(&session, 1);
  EXPECT_EQ(status_, SPHC_E_ARGUMENT);
  expectMentions(sphc_localizer_message(session.localizer()), "config.clock");
  deadline_us_ = 0;
  localize(&session, 1);
  EXPECT_EQ(status_, SPHC_OK);  // and it goes on
}

TEST_F(CInterfacePoseOptions, ADeadlineThatHasPassedEndsTheSearch) {
  int64_t now = 0;
  config_.clock = [](void *user) { return *static_cast<int64_t *>(user) += 10000000; };  // 10 ms a reading
  config_.clock_user = &now;
  deadline_us_ = 1000;
  Session session(config_);
  const sphc_localizer_result result = localize(&session, 1);
  EXPECT_EQ(status_, SPHC_NOT_LOCALIZED);
  EXPECT_EQ(result.outcome, SPHC_OUTCOME_DEADLINE);
  EXPECT_EQ(result.cuts & SPHC_CUT_FEATURES, uint32_t{SPHC_CUT_FEATURES});
  EXPECT_EQ(result.keypoints, 0u);
}

TEST_F(CInterfacePoseOptions, ADistantDeadlineChangesNothing) {
  Session plain(config_);
  int64_t now = 0;
  config_.clock = [](void *user) { return *static_cast<int64_t *>(user) += 1000; };
  config_.clock_user = &now;
  Session timed(config_);
  const sphc_localizer_result a = localize(&plain, 1);
  deadline_us_ = 1000000;
  const sphc_localizer_result b = localize(&timed, 1);
  EXPECT_EQ(std::memcmp(&a.camera_from_map, &b.camera_from_map, sizeof a.camera_from_map), 0);
  EXPECT_EQ(b.cuts, 0u);
}

TEST_F(CInterfacePoseOptions, TheSensorsBiasIsLearntAndTold) {
  config_.depth_offset_sigma_m = 0.003;
  config_.depth_slope_sigma = 0.02;
  Session session(config_);
  const sphc_localizer_result first = localize(&session, 0);
  EXPECT_NEAR(first.depth.slope_sigma, 0.02, 1e-12);
  EXPECT_EQ(first.depth.slope, 0);
  EXPECT_EQ(first.depth.noise_scale, 1);
  EXPECT_NEAR(first.depth.mid_m, std::sqrt(config_.depth_min_m * config_.depth_max_m), 1e-12);
  for (uint32_t viewpoint : {1u, 2u, 3u, 1u, 2u}) localize(&session, viewpoint);
  const sphc_localizer_result later = localize(&session, 3);
  EXPECT_LT(later.depth.slope_sigma, first.depth.slope_sigma);
  EXPECT_NE(later.depth.slope, 0);
  EXPECT_LT(std::abs(later.depth.slope), 0.02);
  EXPECT_NE(later.depth.noise_scale, 1);
}

TEST_F(CInterfacePoseOptions, AKnownSensorIsNotDoubted) {
  Session session(config_);
  for (uint32_t viewpoint : {0u, 1u, 2u}) localize(&session, viewpoint);
  const sphc_localizer_result result = localize(&session, 3);
  EXPECT_EQ(result.depth.slope_sigma, 0);
  EXPECT_EQ(result.depth.noise_scale, 1);
}

TEST_F(CInterfacePoseOptions, HalfABiasPriorIsRefused) {
  config_.depth_slope_sigma = 0.02;
  expectConfigRefused("depth_offset_sigma_m");
}

}  // namespace
