#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "tests/capi/bytes.h"
#include "tests/support/session.h"

namespace {

using sphc::test::expectMentions;
using sphc::test::GuardedMemory;
using sphc::test::Session;

class CInterfaceLocalizer : public testing::Test {
 protected:
  sphc_config config_ = sphc::test::sceneConfig();
  Session session_{config_};
};

sphc_result clean() {
  sphc_result result;
  std::memset(&result, 0, sizeof result);
  return result;
}

TEST_F(CInterfaceLocalizer, SameFramesSameBytes) {
  Session other(config_);
  for (uint32_t viewpoint : {0u, 2u, 1u, 2u}) {
    const auto frame = sphc::test::sceneFrame(config_, viewpoint);
    sphc_result a = clean(), b = clean();
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
  const sphc_map *maps[] = {session_.map()};
  ASSERT_EQ(sphc_localizer_init(state.data(), state.size(), session_.scratch().data(), session_.scratch().size(),
                                &config_, maps, 1, &second, &message),
            SPHC_OK);
  const auto frame = sphc::test::sceneFrame(config_, 1);
  sphc_result a = clean(), b = clean();
  b.struct_size = sizeof b;
  EXPECT_EQ(session_.process(frame->frame, &a), SPHC_OK);
  EXPECT_EQ(sphc_localizer_process(second, &frame->frame, &b), SPHC_OK);
  EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0);
}

TEST_F(CInterfaceLocalizer, KeepsInsideItsMemory) {
  for (uint32_t viewpoint = 0; viewpoint < 4; ++viewpoint) {
    const auto frame = sphc::test::sceneFrame(config_, viewpoint);
    sphc_result result = clean();
    session_.process(frame->frame, &result);
  }
  EXPECT_TRUE(session_.state().guardsIntact());
  EXPECT_TRUE(session_.scratch().guardsIntact());
}

TEST_F(CInterfaceLocalizer, ResultsFieldsAreFilled) {
  const auto frame = sphc::test::sceneFrame(config_, 1);
  sphc_result result;
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
  sphc_result result = clean();
  ASSERT_EQ(session_.process(frame->frame, &result), SPHC_OK);
  const double degrees = sphc::kPi / 180;
  EXPECT_DOUBLE_EQ(sphc_result_confidence(&result, 0.05, 5 * degrees), result.confidence);
  EXPECT_LT(sphc_result_confidence(&result, 0.001, 5 * degrees), result.confidence);
  EXPECT_LT(sphc_result_confidence(&result, 0.05, 0.01 * degrees), result.confidence);
  for (double none : {0.0, -1.0, std::nan("")}) {
    EXPECT_EQ(sphc_result_confidence(&result, none, degrees), 0);
    EXPECT_EQ(sphc_result_confidence(&result, 0.05, none), 0);
  }
  EXPECT_EQ(sphc_result_confidence(nullptr, 0.05, degrees), 0);
  result.outcome = SPHC_OUTCOME_UNCERTAIN;
  EXPECT_EQ(sphc_result_confidence(&result, 0.05, degrees), 0);
}

TEST_F(CInterfaceLocalizer, ClocksMayStepBackOrStandAtTheirEnd) {
  config_.clock = [](void *user) { return *static_cast<int64_t *>(user) -= 1000000; };
  int64_t now = INT64_MAX;
  config_.clock_user = &now;
  Session timed(config_);
  const auto frame = sphc::test::sceneFrame(config_, 0);
  frame->frame.deadline_us = 1000;
  sphc_result result = clean();
  EXPECT_EQ(timed.process(frame->frame, &result), SPHC_OK);
  for (uint32_t us : {result.features_us, result.align_us, result.match_us, result.pose_us}) EXPECT_EQ(us, 0u);
}

TEST_F(CInterfaceLocalizer, StagesAreTimedByTheCallersClock) {
  config_.clock = [](void *user) { return *static_cast<int64_t *>(user) += 1000000; };
  int64_t now = 0;
  config_.clock_user = &now;
  Session timed(config_);
  const auto frame = sphc::test::sceneFrame(config_, 0);
  sphc_result result = clean();
  EXPECT_EQ(timed.process(frame->frame, &result), SPHC_OK);
  for (uint32_t us : {result.features_us, result.align_us, result.match_us, result.pose_us}) EXPECT_GE(us, 1000u);
}

TEST_F(CInterfaceLocalizer, ColorFormatsAgree) {
  const auto gray = sphc::test::sceneFrame(config_, 0);
  std::vector<uint8_t> rgb;
  for (uint8_t value : gray->images.gray) rgb.insert(rgb.end(), 3, value);
  sphc_result results[3] = {clean(), clean(), clean()};
  const sphc_format formats[3] = {SPHC_FORMAT_GRAY8, SPHC_FORMAT_RGB8, SPHC_FORMAT_BGR8};
  for (int i = 0; i < 3; ++i) {
    sphc_frame frame = gray->frame;
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
  sphc_frame wide = tight->frame;
  wide.color.data = color.data(), wide.color.stride_bytes = kColorStride;
  wide.depth.data = depth.data(), wide.depth.stride_bytes = kDepthStride;
  sphc_result a = clean(), b = clean();
  EXPECT_EQ(session_.process(tight->frame, &a), SPHC_OK);
  EXPECT_EQ(session_.process(wide, &b), SPHC_OK);
  EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0);
}

TEST_F(CInterfaceLocalizer, ObservationsTellWhatBecameOfEachKeypoint) {
  uint32_t count = 99;
  EXPECT_EQ(sphc_localizer_observations(session_.localizer(), nullptr, 0, &count), SPHC_OK);
  EXPECT_EQ(count, 0u);  // before the first frame
  const auto frame = sphc::test::sceneFrame(config_, 0);
  sphc_result result = clean();
  ASSERT_EQ(session_.process(frame->frame, &result), SPHC_OK);
  std::vector<sphc_observation> seen(400);
  ASSERT_EQ(sphc_localizer_observations(session_.localizer(), seen.data(), 400, &count), SPHC_OK);
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
  std::vector<sphc_observation> few(5);
  std::memset(few.data(), 0x77, 5 * sizeof few[0]);
  EXPECT_EQ(sphc_localizer_observations(session_.localizer(), few.data(), 4, &count), SPHC_OK);
  EXPECT_EQ(count, result.keypoints);
  EXPECT_EQ(few[4].flags, 0x77777777u);
}

TEST_F(CInterfaceLocalizer, FiniTakesNothing) {
  sphc_localizer_fini(nullptr);
  sphc_localizer *none = nullptr;
  sphc_localizer_fini(&none);
}

}  // namespace
