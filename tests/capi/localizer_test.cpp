#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "tests/capi/bytes.h"
#include "tests/support/session.h"

namespace {

using sphc::test::expectMentions;
using sphc::test::GuardedMemory;
using sphc::test::Session;

class CInterfaceLocalizer : public testing::Test {
 protected:
  sphc_localizer_config config_ = sphc::test::sceneConfig();
  Session session_{config_};
};

sphc_localizer_result clean() {
  sphc_localizer_result result;
  std::memset(&result, 0, sizeof result);
  return result;
}

TEST_F(CInterfaceLocalizer, SameFramesSameBytes) {
  Session other(config_);
  for (uint32_t viewpoint : {0u, 2u, 1u, 2u}) {
    const auto frame = sphc::test::sceneFrame(config_, viewpoint);
    sphc_localizer_result a = clean(), b = clean();
    EXPECT_EQ(session_.process(frame->frame, &a), SPHC_OK);
    if (viewpoint == 2) {  // what scratch held before must not matter
      std::memset(other.scratch().data(), 0x3C, other.scratch().size());
    }
    EXPECT_EQ(other.process(frame->frame, &b), SPHC_OK);
    EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0) << viewpoint;
  }
}

TEST_F(CInterfaceLocalizer, ScratchMayBeSharedByLocalizersOfOneThread) {
  sphc_message message;
  GuardedMemory state(session_.state().size(), 64);
  sphc_localizer *second = nullptr;
  ASSERT_EQ(sphc_localizer_init(state.data(), state.size(), session_.scratch().data(), session_.scratch().size(),
                                &config_, &second, &message),
            SPHC_OK);
  ASSERT_EQ(sphc_localizer_set_map(second, 0, session_.map()), SPHC_OK);
  ASSERT_EQ(sphc_localizer_set_parameter(second, SPHC_PARAMETER_MAX_ITERATIONS, 5000), SPHC_OK);
  const auto frame = sphc::test::sceneFrame(config_, 1);
  sphc_localizer_result a = clean(), b = clean();
  b.struct_size = sizeof b;
  EXPECT_EQ(session_.process(frame->frame, &a), SPHC_OK);
  EXPECT_EQ(sphc_localizer_process(second, &frame->frame, &b), SPHC_OK);
  EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0);
}

TEST_F(CInterfaceLocalizer, KeepsInsideItsMemory) {
  for (uint32_t viewpoint = 0; viewpoint < 4; ++viewpoint) {
    const auto frame = sphc::test::sceneFrame(config_, viewpoint);
    sphc_localizer_result result = clean();
    session_.process(frame->frame, &result);
  }
  EXPECT_TRUE(session_.state().guardsIntact());
  EXPECT_TRUE(session_.scratch().guardsIntact());
}

TEST_F(CInterfaceLocalizer, ResultsFieldsAreFilled) {
  const auto frame = sphc::test::sceneFrame(config_, 1);
  sphc_localizer_result result;
  std::memset(&result, 0xFF, sizeof result);
  ASSERT_EQ(session_.process(frame->frame, &result), SPHC_OK);
  EXPECT_EQ(result.struct_size, sizeof result);
  EXPECT_EQ(result.sequence, 1u);
  EXPECT_EQ(result.time_ns, 1001);
  EXPECT_EQ(result.outcome, SPHC_OUTCOME_LOCALIZED);
  EXPECT_GT(result.iterations, 0u);
  EXPECT_EQ(result.pose_us, 0u);  // no clock was given
  for (int row = 0; row < 6; ++row) {
    EXPECT_GT(result.covariance[7 * row], 0);
    for (int column = 0; column < row; ++column)
      EXPECT_NEAR(result.covariance[6 * row + column], result.covariance[6 * column + row], 1e-12);
  }
}

TEST_F(CInterfaceLocalizer, ConfidenceIsAskedWithinOtherBounds) {
  const auto frame = sphc::test::sceneFrame(config_, 1);
  sphc_localizer_result result = clean();
  ASSERT_EQ(session_.process(frame->frame, &result), SPHC_OK);
  const double degrees = sphc::kPi / 180;
  EXPECT_DOUBLE_EQ(sphc_localizer_result_confidence(&result, 0.05, 5 * degrees), result.confidence);
  EXPECT_LT(sphc_localizer_result_confidence(&result, 0.001, 5 * degrees), result.confidence);
  EXPECT_LT(sphc_localizer_result_confidence(&result, 0.05, 0.01 * degrees), result.confidence);
  for (double none : {0.0, -1.0, std::nan("")}) {
    EXPECT_EQ(sphc_localizer_result_confidence(&result, none, degrees), 0);
    EXPECT_EQ(sphc_localizer_result_confidence(&result, 0.05, none), 0);
  }
  EXPECT_EQ(sphc_localizer_result_confidence(nullptr, 0.05, degrees), 0);
  result.outcome = SPHC_OUTCOME_UNCERTAIN;
  EXPECT_EQ(sphc_localizer_result_confidence(&result, 0.05, degrees), 0);
  ASSERT_EQ(sphc_localizer_result_init(&result, sizeof result), SPHC_OK);
  EXPECT_EQ(sphc_localizer_result_confidence(&result, 0.05, degrees), 0) << "nothing was written to it";
}

// A frame by a clock of the caller's, which shows this before.
sphc_localizer_result timedBy(int64_t (*clock)(void *), int64_t now_ns, sphc_localizer_config config,
                              uint32_t deadline_us = 0) {
  config.clock = clock;
  config.clock_user = &now_ns;
  Session timed(config);
  const auto frame = sphc::test::sceneFrame(config, 0);
  frame->frame.deadline_us = deadline_us;
  sphc_localizer_result result = clean();
  EXPECT_EQ(timed.process(frame->frame, &result), SPHC_OK);
  return result;
}

TEST_F(CInterfaceLocalizer, ClocksMayStepBackOrStandAtTheirEnd) {
  const auto stepBack = [](void *user) { return *static_cast<int64_t *>(user) -= 1000000; };
  const sphc_localizer_result result = timedBy(stepBack, INT64_MAX, config_, 1000);
  for (uint32_t us : {result.features_us, result.align_us, result.match_us, result.pose_us}) EXPECT_EQ(us, 0u);
}

// As a counter of the device that is set anew: of some hours at once a stage is told as the longest that there is.
TEST_F(CInterfaceLocalizer, ClocksMayLeap) {
  const auto leap = [](void *user) { return *static_cast<int64_t *>(user) += 5000000000000; };
  EXPECT_EQ(timedBy(leap, 0, config_).features_us, UINT32_MAX);
}

TEST_F(CInterfaceLocalizer, StagesAreTimedByTheCallersClock) {
  const auto step = [](void *user) { return *static_cast<int64_t *>(user) += 1000000; };
  const sphc_localizer_result result = timedBy(step, 0, config_);
  for (uint32_t us : {result.features_us, result.align_us, result.match_us, result.pose_us}) EXPECT_GE(us, 1000u);
}

TEST_F(CInterfaceLocalizer, ColorFormatsAgree) {
  const auto gray = sphc::test::sceneFrame(config_, 0);
  std::vector<uint8_t> rgb;
  for (uint8_t value : gray->images.gray) rgb.insert(rgb.end(), 3, value);
  sphc_localizer_result results[3] = {clean(), clean(), clean()};
  const sphc_format formats[3] = {SPHC_FORMAT_GRAY8, SPHC_FORMAT_RGB8, SPHC_FORMAT_BGR8};
  for (int i = 0; i < 3; ++i) {
    sphc_localizer_frame frame = gray->frame;
    if (i) frame.color = {rgb.data(), 320, 240, 960, formats[i]};
    EXPECT_EQ(session_.process(frame, &results[i]), SPHC_OK);
  }
  EXPECT_EQ(std::memcmp(&results[0], &results[1], sizeof results[0]), 0);
  EXPECT_EQ(std::memcmp(&results[1], &results[2], sizeof results[0]), 0);
}

TEST_F(CInterfaceLocalizer, StridesWiderThanARow) {
  const auto tight = sphc::test::sceneFrame(config_, 0);
  constexpr uint32_t kColorStride = 333, kDepthStride = 2 * 211;
  std::vector<uint8_t> color(kColorStride * 240, 0xAA), depth(kDepthStride * 160, 0xBB);
  for (uint32_t y = 0; y < 240; ++y) std::memcpy(&color[y * kColorStride], &tight->images.gray[y * 320], 320);
  for (uint32_t y = 0; y < 160; ++y) std::memcpy(&depth[y * kDepthStride], &tight->images.depth_mm[y * 200], 400);
  sphc_localizer_frame wide = tight->frame;
  wide.color.data = color.data(), wide.color.stride_bytes = kColorStride;
  wide.depth.data = depth.data(), wide.depth.stride_bytes = kDepthStride;
  sphc_localizer_result a = clean(), b = clean();
  EXPECT_EQ(session_.process(tight->frame, &a), SPHC_OK);
  EXPECT_EQ(session_.process(wide, &b), SPHC_OK);
  EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0);
}

TEST_F(CInterfaceLocalizer, ObservationsTellWhatBecameOfEachKeypoint) {
  uint32_t count = 99;
  EXPECT_EQ(
      sphc_localizer_observations(session_.localizer(), nullptr, sizeof(sphc_localizer_observation), 0, &count),
      SPHC_OK);
  EXPECT_EQ(count, 0u);  // before the first frame
  const auto frame = sphc::test::sceneFrame(config_, 0);
  sphc_localizer_result result = clean();
  ASSERT_EQ(session_.process(frame->frame, &result), SPHC_OK);
  std::vector<sphc_localizer_observation> seen(400);
  ASSERT_EQ(sphc_localizer_observations(session_.localizer(), seen.data(), sizeof seen[0], 400, &count), SPHC_OK);
  EXPECT_EQ(count, result.keypoints);
  uint32_t lifted = 0, matched = 0, inliers = 0;
  for (uint32_t i = 0; i < count; ++i) {
    lifted += (seen[i].flags & SPHC_OBSERVATION_LIFTED) != 0;
    matched += (seen[i].flags & SPHC_OBSERVATION_MATCHED) != 0;
    inliers += (seen[i].flags & SPHC_OBSERVATION_INLIER) != 0;
    EXPECT_EQ((seen[i].flags & SPHC_OBSERVATION_LIFTED) != 0, seen[i].depth_m > 0);
    EXPECT_TRUE(seen[i].x_px >= 0 && seen[i].x_px <= 320 && seen[i].y_px >= 0 && seen[i].y_px <= 240);
  }
  EXPECT_EQ(lifted, result.lifted);
  EXPECT_EQ(matched, result.matches);
  EXPECT_EQ(inliers, result.inliers);
  std::vector<sphc_localizer_observation> few(5);
  std::memset(few.data(), 0x77, 5 * sizeof few[0]);
  EXPECT_EQ(sphc_localizer_observations(session_.localizer(), few.data(), sizeof few[0], 4, &count), SPHC_OK);
  EXPECT_EQ(count, result.keypoints);
  EXPECT_EQ(few[4].flags, 0x77777777u);
}

TEST_F(CInterfaceLocalizer, ObservationsOfANewerHeaderAreZeroBehindOurs) {
  struct Newer {
    sphc_localizer_observation base;
    uint32_t added;
  };
  const auto frame = sphc::test::sceneFrame(config_, 0);
  sphc_localizer_result result = clean();
  ASSERT_EQ(session_.process(frame->frame, &result), SPHC_OK);
  std::vector<sphc_localizer_observation> plain(8);
  std::vector<Newer> newer(9);
  std::memset(newer.data(), 0x5A, 9 * sizeof newer[0]);
  uint32_t count = 0;
  ASSERT_EQ(sphc_localizer_observations(session_.localizer(), plain.data(), sizeof plain[0], 8, &count), SPHC_OK);
  ASSERT_EQ(sphc_localizer_observations(session_.localizer(), &newer[0].base, sizeof newer[0], 8, &count), SPHC_OK);
  for (size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(std::memcmp(&newer[i].base, &plain[i], sizeof plain[i]), 0);
    EXPECT_EQ(newer[i].added, 0u);
  }
  EXPECT_EQ(newer[8].added, 0x5A5A5A5Au);
}

// What was learnt goes on after a power cut: the next frame has the same bytes.
TEST_F(CInterfaceLocalizer, TheDepthBiasIsGivenBack) {
  config_.depth_offset_sigma_m = 0.003;
  config_.depth_slope_sigma = 0.02;
  Session before(config_), after(config_), fresh(config_);
  for (uint32_t viewpoint : {0u, 1u, 2u, 3u}) {
    const auto frame = sphc::test::sceneFrame(config_, viewpoint);
    sphc_localizer_result result = clean();
    ASSERT_EQ(before.process(frame->frame, &result), SPHC_OK);
  }
  const auto frame = sphc::test::sceneFrame(config_, 1);
  sphc_localizer_result a = clean(), b = clean(), c = clean();
  ASSERT_EQ(before.process(frame->frame, &a), SPHC_OK);
  EXPECT_NE(a.depth.correlation, 0);
  ASSERT_EQ(sphc_localizer_set_depth_bias(after.localizer(), &a.depth), SPHC_OK)
      << sphc_localizer_message(after.localizer());
  ASSERT_EQ(after.process(frame->frame, &b), SPHC_OK);
  ASSERT_EQ(fresh.process(frame->frame, &c), SPHC_OK);
  EXPECT_NEAR(b.depth.offset_m, a.depth.offset_m, 1e-12);
  EXPECT_NEAR(b.depth.correlation, a.depth.correlation, 1e-9);
  EXPECT_NE(c.depth.noise_scale, a.depth.noise_scale);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(b.camera_from_map.t_m[i], a.camera_from_map.t_m[i], 1e-9);
}

TEST_F(CInterfaceLocalizer, InitialStructsSayNothing) {
  sphc_localizer_result result;
  sphc_localizer_frame frame;
  sphc_localizer_prior prior;
  EXPECT_EQ(sphc_localizer_result_init(&result, sizeof result), SPHC_OK);
  EXPECT_EQ(result.struct_size, sizeof result);
  EXPECT_EQ(result.map_id, SPHC_MAP_NONE);
  EXPECT_EQ(result.camera_from_map.q_wxyz[0], 1);
  EXPECT_EQ(sphc_localizer_frame_init(&frame, sizeof frame), SPHC_OK);
  EXPECT_EQ(frame.struct_size, sizeof frame);
  EXPECT_EQ(frame.prior, nullptr);
  EXPECT_EQ(sphc_localizer_prior_init(&prior, sizeof prior), SPHC_OK);
  EXPECT_EQ(prior.struct_size, sizeof prior);
  EXPECT_EQ(prior.odometry_from_camera.q_wxyz[0], 1);
  const auto made = sphc::test::sceneFrame(config_, 1);
  made->frame.prior = &prior;  // says nothing
  EXPECT_EQ(session_.process(made->frame, &result), SPHC_OK);
  EXPECT_EQ(sphc_localizer_result_init(nullptr, sizeof result), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_localizer_frame_init(&frame, 8), SPHC_E_STRUCT_SIZE);
  EXPECT_EQ(sphc_localizer_prior_init(&prior, sizeof prior + 1), SPHC_E_STRUCT_SIZE);
}

// Of this level alone.
template <sphc_log_level kLevel>
void logTo(std::vector<std::string> *lines, sphc_localizer_config *config) {
  config->log = [](void *user, sphc_log_level level, const char *text, size_t length) {
    EXPECT_EQ(level, kLevel);
    EXPECT_EQ(text[length], '\0');
    static_cast<std::vector<std::string> *>(user)->push_back(text);
  };
  config->log_user = lines;
}

TEST_F(CInterfaceLocalizer, LogsOnlyWhatTheLevelAsksFor) {
  std::vector<std::string> lines;
  logTo<SPHC_LOG_DEBUG>(&lines, &config_);
  const auto frame = sphc::test::sceneFrame(config_, 1);
  for (sphc_log_level level : {SPHC_LOG_ERROR, SPHC_LOG_WARNING, SPHC_LOG_INFO, SPHC_LOG_DEBUG}) {
    config_.log_level = level;
    Session logged(config_);
    sphc_localizer_result result = clean();
    ASSERT_EQ(logged.process(frame->frame, &result), SPHC_OK);
    EXPECT_EQ(lines.size(), level == SPHC_LOG_DEBUG ? 1u : 0u);
  }
  expectMentions(lines.front().c_str(), "frame 1: SPHC_OUTCOME_LOCALIZED");
}

TEST_F(CInterfaceLocalizer, WarnsOnceOfWhatTheCallerForgot) {
  std::vector<std::string> lines;
  logTo<SPHC_LOG_WARNING>(&lines, &config_);
  const auto made = sphc::test::sceneFrame(config_, 1);
  made->frame.depth_time_ns = made->frame.color_time_ns - 2000000000;  // of another clock
  Session logged(config_);
  ASSERT_EQ(sphc_localizer_remove_map(logged.localizer(), 0), SPHC_OK);
  sphc_localizer_result result = clean();
  for (int again = 0; again < 2; ++again) EXPECT_EQ(logged.process(made->frame, &result), SPHC_NOT_LOCALIZED);
  ASSERT_EQ(lines.size(), 2u);
  expectMentions(lines[0].c_str(), "the images of a frame are 1 s apart or more");
  expectMentions(lines[1].c_str(), "sphc_localizer_set_map");
}

TEST_F(CInterfaceLocalizer, WarnsOnceOfImagesThatNothingBringsTogether) {
  std::vector<std::string> lines;
  logTo<SPHC_LOG_WARNING>(&lines, &config_);
  const auto made = sphc::test::sceneFrame(config_, 1);
  config_.mode = SPHC_MODE_TRACKING;
  Session logged(config_);
  sphc_localizer_prior prior;
  ASSERT_EQ(sphc_localizer_prior_init(&prior, sizeof prior), SPHC_OK);
  prior.flags = SPHC_PRIOR_ODOMETRY;
  prior.odometry_rotation_sigma_rad = prior.odometry_translation_sigma_m = 1e-3;
  sphc_localizer_result result = clean();
  made->frame.depth_time_ns = made->frame.color_time_ns - 60000000;
  made->frame.prior = &prior;
  EXPECT_EQ(logged.process(made->frame, &result), SPHC_OK);
  EXPECT_EQ(lines.size(), 0u) << "odometry will say it";
  made->frame.prior = nullptr;
  for (int again = 0; again < 2; ++again) EXPECT_EQ(logged.process(made->frame, &result), SPHC_OK);
  EXPECT_LT(result.confidence, 0.9f);
  ASSERT_EQ(lines.size(), 1u);
  expectMentions(lines[0].c_str(), "more than 50 ms apart");
  expectMentions(lines[0].c_str(), "SPHC_PRIOR_ODOMETRY");
}

TEST_F(CInterfaceLocalizer, WarnsOnceOfTimesThatDoNotGrow) {
  std::vector<std::string> lines;
  logTo<SPHC_LOG_WARNING>(&lines, &config_);
  config_.mode = SPHC_MODE_TRACKING;
  Session logged(config_);
  sphc_localizer_result result = clean();
  const auto see = [&](int64_t time_ns) {
    const auto made = sphc::test::sceneFrame(config_, 1);
    made->frame.color_time_ns = made->frame.depth_time_ns = time_ns;
    EXPECT_EQ(logged.process(made->frame, &result), SPHC_OK);
    return lines.size();
  };
  for (int64_t time_ns : {1000000000, 1033000000, 0, 33000000, 66000000}) EXPECT_EQ(see(time_ns), 0u);
  EXPECT_EQ(see(66000000), 0u);
  EXPECT_EQ(see(66000000), 0u);
  for (int again = 0; again < 2; ++again) EXPECT_EQ(see(66000000), 1u);
  expectMentions(lines[0].c_str(), "color_time_ns does not grow");
  config_.mode = SPHC_MODE_SINGLE;
  Session single(config_);
  const auto made = sphc::test::sceneFrame(config_, 1);
  for (int again = 0; again < 5; ++again) EXPECT_EQ(single.process(made->frame, &result), SPHC_OK);
  EXPECT_EQ(lines.size(), 1u) << "frames alone need no times";
}

TEST_F(CInterfaceLocalizer, WarnsOnceOfEachFault) {
  std::vector<std::string> lines;
  logTo<SPHC_LOG_WARNING>(&lines, &config_);
  const auto made = sphc::test::sceneFrame(config_, 1);
  const std::vector<uint16_t> constant(size_t{made->frame.depth.width} * made->frame.depth.height, 1500);
  made->frame.depth.data = constant.data();
  made->frame.depth.stride_bytes = 2 * made->frame.depth.width;
  Session logged(config_);
  for (int again = 0; again < 2; ++again) {
    sphc_localizer_result result = clean();
    ASSERT_EQ(logged.process(made->frame, &result), SPHC_NOT_LOCALIZED);
    ASSERT_EQ(result.faults & SPHC_FAULT_DEPTH_CONSTANT, uint32_t{SPHC_FAULT_DEPTH_CONSTANT});
  }
  ASSERT_EQ(lines.size(), 1u);
  expectMentions(lines.front().c_str(), "frame 1: SPHC_FAULT_DEPTH_CONSTANT");
  sphc_localizer_reset(logged.localizer());
  sphc_localizer_result result = clean();
  logged.process(made->frame, &result);
  EXPECT_EQ(lines.size(), 2u) << "after a reset it is told again";
  config_.log_level = SPHC_LOG_ERROR;
  Session quiet(config_);
  quiet.process(made->frame, &result);
  EXPECT_EQ(lines.size(), 2u);
}

// Parameters count from the next frame on.
TEST_F(CInterfaceLocalizer, ParametersCountFromTheNextFrameOn) {
  const auto frame = sphc::test::sceneFrame(config_, 1);
  sphc_localizer_result first = clean(), strict = clean(), again = clean();
  ASSERT_EQ(session_.process(frame->frame, &first), SPHC_OK);
  session_.setParameter(SPHC_PARAMETER_MIN_INLIERS, first.inliers + 500);
  EXPECT_EQ(session_.process(frame->frame, &strict), SPHC_NOT_LOCALIZED);
  session_.setParameter(SPHC_PARAMETER_MIN_INLIERS, 10);
  session_.setParameter(SPHC_PARAMETER_MAX_RATIO, 0.6);
  EXPECT_EQ(session_.process(frame->frame, &again), SPHC_OK);
  EXPECT_LT(again.matches, first.matches);
  double value = 0;
  EXPECT_EQ(sphc_localizer_get_parameter(session_.localizer(), SPHC_PARAMETER_MAX_RATIO, &value), SPHC_OK);
  EXPECT_EQ(value, 0.6);
}

TEST_F(CInterfaceLocalizer, FiniTakesNothing) {
  sphc_localizer_fini(nullptr);
  sphc_localizer *none = nullptr;
  sphc_localizer_fini(&none);
}

}  // namespace
