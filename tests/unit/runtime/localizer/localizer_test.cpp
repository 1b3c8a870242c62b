// The stages together, on the test room.
#include "runtime/localizer/localizer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "runtime/capi/translate.h"
#include "tests/support/arena_memory.h"
#include "tests/support/session.h"
#include "tests/unit/runtime/localizer/room_points.h"

namespace sphc {
namespace {

TEST(Localizer, LocalizesInItsRoom) {
  const sphc_localizer_config config = test::sceneConfig();
  test::Session session(config);
  for (uint32_t viewpoint : {0u, 1u, 2u, 3u}) {  // 3 is none of the map's
    const auto frame = test::sceneFrame(config, viewpoint);
    sphc_localizer_result result;
    EXPECT_EQ(session.process(frame->frame, &result), SPHC_OK) << viewpoint << " outcome " << result.outcome;
    EXPECT_LT(session.errorM(result, viewpoint), 0.02) << viewpoint;
    EXPECT_LE(result.inliers, result.matches);
    EXPECT_LE(result.matches, result.lifted);
    EXPECT_LE(result.lifted, result.keypoints);
  }
}

// The room is small, and nearly plane as it is seen from here: of a plane seen straight on no focal length shows.
TEST(Localizer, AFocalLengthThatTheMatchesDoNotAgreeWithIsNamed) {
  const sphc_localizer_config config = test::sceneConfig();
  for (const double stated_over_true : {0.85, 1.0}) {
    sphc_localizer_config stated = config;
    for (sphc_camera *camera : {&stated.rig.color_camera, &stated.rig.depth_camera})
      for (int i = 0; i < 2; ++i) camera->params[i] *= stated_over_true;
    test::Session session(stated);
    const auto frame = test::sceneFrame(config, 5);
    sphc_localizer_result result;
    EXPECT_EQ(session.process(frame->frame, &result), SPHC_OK) << stated_over_true;
    EXPECT_EQ(result.faults, stated_over_true < 1 ? uint32_t{SPHC_FAULT_FOCAL_DISAGREES} : 0u);
    EXPECT_EQ(result.confidence <= 0.5, stated_over_true < 1) << result.confidence;
    frame->frame.color_time_ns += 100000000;
    session.process(frame->frame, &result);
    EXPECT_EQ(result.faults, 0u) << "images of other times disagree for another reason";
  }
}

TEST(Localizer, MoreBiasThanASoundDepthSensorHasIsNamed) {
  sphc_localizer_config config = test::sceneConfig();
  config.depth_offset_sigma_m = 0.003;
  config.depth_slope_sigma = 0.001;
  test::Session session(config);
  const auto frame = test::sceneFrame(config, 0);
  sphc_localizer_result result;
  ASSERT_EQ(session.process(frame->frame, &result), SPHC_OK);
  EXPECT_EQ(result.faults, 0u);
  result.depth.offset_m = 0.1;
  ASSERT_EQ(sphc_localizer_set_depth_bias(session.localizer(), &result.depth), SPHC_OK);
  session.process(frame->frame, &result);
  EXPECT_EQ(result.faults, uint32_t{SPHC_FAULT_DEPTH_BIAS});
}

TEST(Localizer, DarknessHasFewKeypoints) {
  const sphc_localizer_config config = test::sceneConfig();
  test::Session session(config);
  const auto frame = test::sceneFrame(config, 0);
  std::fill(frame->images.gray.begin(), frame->images.gray.end(), uint8_t{7});
  sphc_localizer_result result;
  EXPECT_EQ(session.process(frame->frame, &result), SPHC_NOT_LOCALIZED);
  EXPECT_EQ(result.outcome, SPHC_OUTCOME_FEW_KEYPOINTS);
  EXPECT_NE(result.hints & SPHC_HINT_TOO_DARK, 0u);
}

TEST(Localizer, ABlindDepthSensorHasFewDepths) {
  const sphc_localizer_config config = test::sceneConfig();
  test::Session session(config);
  const auto frame = test::sceneFrame(config, 0);
  std::fill(frame->images.depth_mm.begin(), frame->images.depth_mm.end(), uint16_t{0});
  sphc_localizer_result result;
  EXPECT_EQ(session.process(frame->frame, &result), SPHC_NOT_LOCALIZED);
  EXPECT_EQ(result.outcome, SPHC_OUTCOME_FEW_DEPTHS);
  EXPECT_EQ(result.hints, uint32_t{SPHC_HINT_NO_DEPTH_IN_RANGE});
  EXPECT_EQ(result.lifted, 0u);
}

TEST(Localizer, AnotherPlaceIsNotLocalized) {
  const sphc_localizer_config config = test::sceneConfig();
  test::Session session(config);
  const auto frame = test::sceneFrame(config, 0);
  for (auto row = frame->images.gray.begin(); row != frame->images.gray.end(); row += 320)
    std::reverse(row, row + 320);  // a mirror world
  sphc_localizer_result result;
  EXPECT_EQ(session.process(frame->frame, &result), SPHC_NOT_LOCALIZED);
  EXPECT_NE(result.outcome, SPHC_OUTCOME_LOCALIZED);
  EXPECT_EQ(result.hints, uint32_t{SPHC_HINT_NOT_IN_MAP});
}

// In a map whose points pass a looser ratio test only.
LocalizerResult localizeLoosely(uint32_t min_inliers) {
  const sphc_localizer_config asked = test::sceneConfig();
  LocalizerConfig config = localizerConfigFrom(asked);
  config.search.min_inliers = min_inliers;
  Localizer localizer;
  test::ArenaMemory memory(
      [&](Arena &arena, bool real) { Localizer::layout(config, arena, arena, real ? &localizer : nullptr); });
  localizer.init(config);
  const auto maps = test::mapOf(test::pointsWithNearDuplicates(), Vector3(0, 0, 1));
  MapView view;
  EXPECT_EQ(MapView::open(maps[0].file.data(), maps[0].file.size(), kExtractorId, &view, nullptr), SPHC_OK);
  localizer.setMap(0, view);
  const auto frame = test::sceneFrame(asked, 0);
  return localizer.process(frameFrom(frame->frame, MapSet()));
}

TEST(Localizer, WhatALooserSearchFindsNeedsTwiceTheInliers) {
  const LocalizerResult enough = localizeLoosely(10);
  ASSERT_EQ(enough.outcome, Outcome::kLocalized);
  EXPECT_EQ(localizeLoosely(enough.inliers / 2).outcome, Outcome::kLocalized);
  const LocalizerResult few = localizeLoosely(enough.inliers / 2 + 1);
  EXPECT_EQ(few.outcome, Outcome::kFewMatches);
  EXPECT_LT(few.matches, enough.matches) << "the frame as the strict test shows it";
}

TEST(Localizer, LogsOnTheCallersThread) {
  sphc_localizer_config config = test::sceneConfig();
  std::string text;
  config.log_level = SPHC_LOG_DEBUG;
  config.log_user = &text;
  config.log = [](void *user, sphc_log_level, const char *line, size_t length) {
    static_cast<std::string *>(user)->append(line, length);
  };
  test::Session session(config);
  const auto frame = test::sceneFrame(config, 1);
  sphc_localizer_result result;
  session.process(frame->frame, &result);
  EXPECT_NE(text.find("frame 1: SPHC_OUTCOME_LOCALIZED"), std::string::npos) << text;
}

}  // namespace
}  // namespace sphc
