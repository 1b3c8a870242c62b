// Where the camera is at other times than those of frames, and how far a pose jumps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "tests/capi/bytes.h"
#include "tests/support/session.h"

namespace {

using sphc::test::Session;

constexpr int64_t kStepNs = 100000000, kSecondNs = 1000000000;

class CInterfacePredict : public testing::Test {
 protected:
  CInterfacePredict() {
    config_.mode = SPHC_MODE_TRACKING;
    session_ = std::make_unique<Session>(config_, 0.5, 2);
  }
  // The next frame, a tenth of a second later.
  sphc_localizer_result see(uint32_t viewpoint, uint32_t room = 0) {
    const auto made = sphc::test::sceneFrame(config_, viewpoint, room);
    made->frame.color_time_ns = made->frame.depth_time_ns = time_ns_ += kStepNs;
    sphc_localizer_result result = {};
    EXPECT_EQ(session_->process(made->frame, &result), SPHC_OK);
    return result;
  }
  sphc_localizer_prediction predict(int64_t time_ns, sphc_status expected) {
    sphc_localizer_prediction prediction;
    std::memset(&prediction, 0x5A, sizeof prediction);
    prediction.struct_size = sizeof prediction;
    EXPECT_EQ(sphc_localizer_predict(session_->localizer(), time_ns, &prediction), expected) << time_ns;
    EXPECT_EQ(prediction.struct_size, sizeof prediction);
    EXPECT_EQ(prediction.time_ns, time_ns);
    EXPECT_EQ(prediction.reserved, 0u);
    if (expected == SPHC_OK) return prediction;
    EXPECT_EQ(prediction.map_id, SPHC_MAP_NONE);
    EXPECT_EQ(prediction.pose_time_ns, 0);
    EXPECT_EQ(prediction.camera_from_map.q_wxyz[0], 1);
    EXPECT_EQ(prediction.camera_from_map.t_m[0], 0);
    EXPECT_EQ(prediction.covariance[0], 0);
    EXPECT_EQ(prediction.velocity_sigma_m_s, 0);
    return prediction;
  }
  sphc_localizer_config config_ = sphc::test::sceneConfig();
  std::unique_ptr<Session> session_;
  int64_t time_ns_ = 0;
};

TEST_F(CInterfacePredict, NothingIsKnownBeforeTheFirstPose) {
  predict(0, SPHC_NOT_LOCALIZED);
  see(0);
  predict(time_ns_, SPHC_OK);
  sphc_localizer_reset(session_->localizer());
  predict(time_ns_, SPHC_NOT_LOCALIZED);
}

TEST_F(CInterfacePredict, AtTheTimeOfAFrameItIsItsPose) {
  see(0), see(1);
  const sphc_localizer_result result = see(2);
  const sphc_localizer_prediction prediction = predict(time_ns_, SPHC_OK);
  EXPECT_EQ(prediction.map_id, 0u);
  EXPECT_EQ(prediction.pose_time_ns, time_ns_);
  EXPECT_EQ(prediction.state, SPHC_STATE_TRACKING);
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(prediction.camera_from_map.q_wxyz[i], result.camera_from_map.q_wxyz[i], 1e-14);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(prediction.camera_from_map.t_m[i], result.camera_from_map.t_m[i], 1e-14);
  for (int i = 0; i < 36; ++i) EXPECT_NEAR(prediction.covariance[i], result.covariance[i], 1e-18);
}

TEST_F(CInterfacePredict, AheadItGoesOn) {
  for (uint32_t viewpoint : {0u, 1u, 2u, 3u}) see(viewpoint);
  const sphc_localizer_prediction now = predict(time_ns_, SPHC_OK), ahead = predict(time_ns_ + kStepNs, SPHC_OK),
                                  between = predict(time_ns_ - kStepNs / 2, SPHC_OK);
  const auto errorM = [this](const sphc_localizer_prediction &prediction, double viewpoint) {
    sphc_rigid found, truth = sphc::rigidToC(sphc::test::sceneViewpoint(viewpoint).inverse());
    sphc_rigid_inverse(&prediction.camera_from_map, &found);
    const auto &centre = session_->sceneMap().centre_in_world_m;
    return std::hypot(found.t_m[0] + centre[0] - truth.t_m[0], found.t_m[1] + centre[1] - truth.t_m[1],
                      found.t_m[2] + centre[2] - truth.t_m[2]);
  };
  EXPECT_LT(errorM(ahead, 4), 0.3 * errorM(now, 4));
  EXPECT_LT(errorM(between, 2.5), 0.3 * errorM(now, 2.5));
  EXPECT_GT(ahead.covariance[0], now.covariance[0]);
  EXPECT_GT(ahead.covariance[35], now.covariance[35]);
  EXPECT_NEAR(now.velocity_in_map_m_s[0], 0.5, 0.1);
  EXPECT_NEAR(now.velocity_in_map_m_s[1], -0.2, 0.1);
  EXPECT_NEAR(now.velocity_in_map_m_s[2], 0.4, 0.1);
  EXPECT_NEAR(now.angular_velocity_in_map_rad_s[1], -0.4, 0.1);
  EXPECT_GT(now.velocity_sigma_m_s, 0);
  EXPECT_GT(now.angular_velocity_sigma_rad_s, 0);
}

TEST_F(CInterfacePredict, ForASecondAfterTheLastPose) {
  see(0), see(1);
  predict(time_ns_ + kSecondNs, SPHC_OK);
  predict(time_ns_ + kSecondNs + 1, SPHC_NOT_LOCALIZED);
  predict(time_ns_ - kStepNs, SPHC_OK);
  predict(time_ns_ - kStepNs - 1, SPHC_NOT_LOCALIZED);
}

// Odometry leads on for longer, and says where to search; it is no pose.
TEST_F(CInterfacePredict, NotFromAnOlderPoseHoweverOdometryLedOn) {
  see(0), see(1);
  const auto blind = sphc::test::sceneFrame(config_, 1);
  std::fill(blind->images.gray.begin(), blind->images.gray.end(), uint8_t{90});
  sphc_localizer_prior prior;
  ASSERT_EQ(sphc_localizer_prior_init(&prior, sizeof prior), SPHC_OK);
  prior.flags = SPHC_PRIOR_ODOMETRY;
  prior.odometry_rotation_sigma_rad = prior.odometry_translation_sigma_m = 1e-3;
  blind->frame.prior = &prior;
  // With the last pose too, from which odometry leads on.
  const auto made = sphc::test::sceneFrame(config_, 1);
  made->frame.prior = &prior;
  sphc_localizer_result result = {};
  result.struct_size = sizeof result;
  made->frame.color_time_ns = made->frame.depth_time_ns = time_ns_ += kStepNs;
  ASSERT_EQ(session_->process(made->frame, &result), SPHC_OK);
  const int64_t pose_ns = time_ns_;
  for (int i = 0; i < 11; ++i) {
    blind->frame.color_time_ns = blind->frame.depth_time_ns = time_ns_ += kStepNs;
    ASSERT_EQ(session_->process(blind->frame, &result), SPHC_NOT_LOCALIZED);
  }
  EXPECT_EQ(predict(pose_ns + kSecondNs, SPHC_OK).pose_time_ns, pose_ns);
  for (const int64_t time_ns : {pose_ns + kSecondNs + 1, time_ns_ - 1, time_ns_})
    predict(time_ns, SPHC_NOT_LOCALIZED);
}

TEST_F(CInterfacePredict, TimesMayLieAnywhere) {
  constexpr int64_t kFirst = std::numeric_limits<int64_t>::min(), kLast = std::numeric_limits<int64_t>::max();
  for (const int64_t frame_ns : {kFirst + kStepNs, int64_t{0}, kLast}) {
    sphc_localizer_reset(session_->localizer());
    time_ns_ = frame_ns - kStepNs;
    see(0);
    for (const int64_t time_ns : {kFirst, kFirst + kStepNs, int64_t{0}, kLast}) {
      const double ahead_ns = static_cast<double>(time_ns) - static_cast<double>(frame_ns);
      predict(time_ns, ahead_ns <= kSecondNs && ahead_ns >= -kStepNs ? SPHC_OK : SPHC_NOT_LOCALIZED);
    }
  }
}

TEST_F(CInterfacePredict, AMapThatWasRemovedHasNoPose) {
  see(1, 1), see(2, 1);
  EXPECT_EQ(predict(time_ns_, SPHC_OK).map_id, 1u);
  ASSERT_EQ(sphc_localizer_remove_map(session_->localizer(), 1), SPHC_OK);
  predict(time_ns_, SPHC_NOT_LOCALIZED);
}

TEST_F(CInterfacePredict, SingleFramesTellNoMotion) {
  config_.mode = SPHC_MODE_SINGLE;
  session_ = std::make_unique<Session>(config_);
  const sphc_localizer_result result = see(0);
  EXPECT_EQ(result.events, 0u);
  predict(time_ns_, SPHC_NOT_LOCALIZED);
}

TEST_F(CInterfacePredict, ChangesNothing) {
  Session other(config_, 0.5, 2);
  int64_t time_ns = 0;
  for (uint32_t viewpoint : {0u, 1u, 2u}) {
    const sphc_localizer_result result = see(viewpoint);
    const std::vector<uint8_t> state = session_->state().copy(), scratch = session_->scratch().copy();
    for (const int64_t ahead_ns : {-kSecondNs, int64_t{0}, int64_t{16000000}, 2 * kSecondNs}) {
      sphc_localizer_prediction prediction = {};
      prediction.struct_size = sizeof prediction;
      EXPECT_GE(sphc_localizer_predict(session_->localizer(), time_ns_ + ahead_ns, &prediction), 0);
    }
    EXPECT_EQ(session_->state().copy(), state);
    EXPECT_EQ(session_->scratch().copy(), scratch);
    const auto made = sphc::test::sceneFrame(config_, viewpoint);
    made->frame.color_time_ns = made->frame.depth_time_ns = time_ns += kStepNs;
    sphc_localizer_result unasked = {};
    other.process(made->frame, &unasked);
    EXPECT_EQ(std::memcmp(&unasked, &result, sizeof result), 0) << viewpoint;
  }
}

TEST_F(CInterfacePredict, Refused) {
  see(0);
  sphc_localizer *localizer = session_->localizer();
  sphc::test::Output<sphc_localizer_prediction> prediction;
  const sphc_localizer_prediction before = *prediction.get();
  prediction->struct_size = sizeof before;
  EXPECT_EQ(sphc_localizer_predict(nullptr, 0, prediction.get()), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_localizer_predict(localizer, 0, nullptr), SPHC_E_ARGUMENT);
  for (const uint32_t size : {0u, 8u, uint32_t{sizeof before} - 8, uint32_t{sizeof before} + 1, 5000u}) {
    prediction->struct_size = size;
    EXPECT_EQ(sphc_localizer_predict(localizer, time_ns_, prediction.get()), SPHC_E_STRUCT_SIZE) << size;
  }
  prediction->struct_size = before.struct_size;
  EXPECT_EQ(std::memcmp(prediction.get(), &before, sizeof before), 0);
  EXPECT_EQ(sphc_localizer_prediction_init(nullptr, sizeof before), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_localizer_prediction_init(prediction.get(), 8), SPHC_E_STRUCT_SIZE);
  ASSERT_EQ(sphc_localizer_prediction_init(prediction.get(), sizeof before), SPHC_OK);
  EXPECT_EQ(prediction->struct_size, sizeof before);
  EXPECT_EQ(prediction->map_id, SPHC_MAP_NONE);
  EXPECT_EQ(prediction->camera_from_map.q_wxyz[0], 1);
  EXPECT_EQ(prediction->covariance[7], 0);
}

// A newer program's prediction is longer.
TEST_F(CInterfacePredict, Grows) {
  see(0);
  struct {
    sphc_localizer_prediction base;
    uint64_t added;
  } newer;
  std::memset(&newer, 0x5A, sizeof newer);
  newer.base.struct_size = sizeof newer;
  EXPECT_EQ(sphc_localizer_predict(session_->localizer(), time_ns_, &newer.base), SPHC_OK);
  EXPECT_EQ(newer.added, 0u);
}

TEST_F(CInterfacePredict, APoseTellsHowFarTheWorldJumps) {
  const sphc_localizer_result first = see(0);
  EXPECT_EQ(first.events, uint32_t{SPHC_EVENT_RELOCALIZED});
  EXPECT_EQ(first.jump_m, 0);
  EXPECT_EQ(first.jump_rad, 0);
  for (uint32_t viewpoint : {1u, 2u, 3u}) {
    const sphc_localizer_prediction expected = predict(time_ns_ + kStepNs, SPHC_OK);
    const sphc_localizer_result result = see(viewpoint);
    EXPECT_EQ(result.events, 0u) << viewpoint;
    sphc_rigid a, b;
    sphc_rigid_inverse(&expected.camera_from_map, &a);
    sphc_rigid_inverse(&result.camera_from_map, &b);
    const double off_m = std::hypot(a.t_m[0] - b.t_m[0], a.t_m[1] - b.t_m[1], a.t_m[2] - b.t_m[2]);
    EXPECT_NEAR(result.jump_m, off_m, 2e-3) << viewpoint;
    EXPECT_GT(result.jump_m, 0);
  }
  sphc_localizer_reset(session_->localizer());
  see(4);  // one pose is no track, which would not let the next one go so far
  const sphc_localizer_result jumped = see(14);
  EXPECT_EQ(jumped.events, uint32_t{SPHC_EVENT_JUMPED});
  EXPECT_NEAR(jumped.jump_m, 10 * std::hypot(0.05, 0.02, 0.04), 0.05);
  EXPECT_NEAR(jumped.jump_rad, 10 * std::hypot(0.02, 0.04, 0.015), 0.05);
  const sphc_localizer_result moved = see(2, 1);
  EXPECT_EQ(moved.events, uint32_t{SPHC_EVENT_MAP_CHANGED});
  EXPECT_EQ(moved.jump_m, 0);
  time_ns_ += 2 * kSecondNs;
  EXPECT_EQ(see(2, 1).events, uint32_t{SPHC_EVENT_RELOCALIZED});
}

}  // namespace
