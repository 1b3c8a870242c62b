// Maps that come and go between frames.
#include <gtest/gtest.h>

#include <cstring>

#include "tests/capi/bytes.h"
#include "tests/support/session.h"

namespace {

using sphc::test::GuardedMemory;
using sphc::test::Session;

constexpr uint32_t kRooms = 3;

class CInterfaceMaps : public testing::Test {
 protected:
  CInterfaceMaps() {
    config_.mode = SPHC_MODE_TRACKING;
    session_ = std::make_unique<Session>(config_, 0.5, kRooms);
  }
  // The next frame, a tenth of a second later.
  sphc_localizer_result see(uint32_t viewpoint, uint32_t room) {
    const auto made = sphc::test::sceneFrame(config_, viewpoint, room);
    made->frame.color_time_ns = made->frame.depth_time_ns = time_ns_ += 100000000;
    sphc_localizer_result result = {};
    EXPECT_GE(session_->process(made->frame, &result), 0);
    return result;
  }
  sphc_localizer *localizer() { return session_->localizer(); }
  void removeAll() {
    for (uint32_t room = 0; room < kRooms; ++room) EXPECT_EQ(sphc_localizer_remove_map(localizer(), room), SPHC_OK);
  }

  sphc_localizer_config config_ = sphc::test::sceneConfig();
  std::unique_ptr<Session> session_;
  int64_t time_ns_ = 0;
};

TEST_F(CInterfaceMaps, WithoutAMapThereIsNoPose) {
  removeAll();
  EXPECT_EQ(sphc_localizer_map_count(localizer()), 0u);
  const sphc_localizer_result result = see(0, 0);
  EXPECT_EQ(result.outcome, SPHC_OUTCOME_FEW_MATCHES);
  EXPECT_EQ(result.map_id, SPHC_MAP_NONE);
  EXPECT_GT(result.keypoints, 0u);
}

TEST_F(CInterfaceMaps, AMapThatComesIsFoundUnderItsId) {
  removeAll();
  ASSERT_EQ(sphc_localizer_set_map(localizer(), 4000000000u, session_->map(1)), SPHC_OK);
  const sphc_localizer_result result = see(0, 1);
  EXPECT_EQ(result.outcome, SPHC_OUTCOME_LOCALIZED);
  EXPECT_EQ(result.map_id, 4000000000u);
  EXPECT_NE(see(0, 0).outcome, SPHC_OUTCOME_LOCALIZED);
}

TEST_F(CInterfaceMaps, OthersComeAndGoWhileOneIsTracked) {
  see(0, 1), see(1, 1);
  for (uint32_t viewpoint : {2u, 3u, 4u}) {
    ASSERT_EQ(sphc_localizer_remove_map(localizer(), viewpoint % 2 ? 0 : 2), SPHC_OK);
    const sphc_localizer_result result = see(viewpoint, 1);
    EXPECT_EQ(result.state, SPHC_STATE_TRACKING);
    EXPECT_EQ(result.guided, 1u);
    EXPECT_EQ(result.map_id, 1u);
    ASSERT_EQ(sphc_localizer_set_map(localizer(), viewpoint % 2 ? 0 : 2, session_->map(viewpoint % 2 ? 0 : 2)),
              SPHC_OK);
  }
}

TEST_F(CInterfaceMaps, TheTrackedMapIsReplacedByAnotherReleaseOfIt) {
  const auto other = sphc::test::makeSceneMap(config_.rig.color_camera, config_.max_keypoints, 3, 0.7, 1);
  GuardedMemory view(SPHC_MAP_BYTES_MAX, 64);
  sphc_map *release = nullptr;
  ASSERT_EQ(sphc_map_init(view.data(), view.size(), other.file.data(), other.file.size(), &release, nullptr),
            SPHC_OK);
  see(0, 1);
  EXPECT_EQ(see(1, 1).state, SPHC_STATE_TRACKING);
  ASSERT_EQ(sphc_localizer_set_map(localizer(), 1, release), SPHC_OK);
  EXPECT_EQ(sphc_localizer_map_count(localizer()), kRooms);
  const sphc_localizer_result result = see(2, 1);
  EXPECT_EQ(result.state, SPHC_STATE_TRACKING);
  EXPECT_EQ(result.guided, 1u);
  EXPECT_LT(session_->errorM(result, 2), 0.03);
}

TEST_F(CInterfaceMaps, WhatWasTrackedInARemovedMapIsForgotten) {
  see(0, 1);
  EXPECT_EQ(see(1, 1).state, SPHC_STATE_TRACKING);
  ASSERT_EQ(sphc_localizer_remove_map(localizer(), 1), SPHC_OK);
  const sphc_localizer_result gone = see(2, 1);
  EXPECT_NE(gone.outcome, SPHC_OUTCOME_LOCALIZED);
  EXPECT_EQ(gone.state, SPHC_STATE_RELOCALIZING);
  // Another room in its slot is found by a search, not where the camera was before.
  ASSERT_EQ(sphc_localizer_set_map(localizer(), 8, session_->map(2)), SPHC_OK);
  ASSERT_EQ(sphc_localizer_remove_map(localizer(), 2), SPHC_OK);
  const sphc_localizer_result result = see(3, 2);
  EXPECT_EQ(result.map_id, 8u);
  EXPECT_EQ(result.guided, 0u);
}

TEST_F(CInterfaceMaps, APriorNamesAMapThatIsThere) {
  const auto made = sphc::test::sceneFrame(config_, 1, 1);
  sphc_localizer_result found = see(1, 1), result = {};
  ASSERT_EQ(found.outcome, SPHC_OUTCOME_LOCALIZED);
  sphc_localizer_prior prior;
  ASSERT_EQ(sphc_localizer_prior_init(&prior, sizeof prior), SPHC_OK);
  prior.flags = SPHC_PRIOR_POSE;
  prior.map_id = 1;
  prior.camera_from_map = found.camera_from_map;
  prior.rotation_sigma_rad = prior.translation_sigma_m = 0.01;
  made->frame.prior = &prior;
  made->frame.color_time_ns = made->frame.depth_time_ns = time_ns_ += 100000000;
  EXPECT_EQ(session_->process(made->frame, &result), SPHC_OK);
  EXPECT_EQ(result.guided, 1u);
  ASSERT_EQ(sphc_localizer_remove_map(localizer(), 1), SPHC_OK);
  EXPECT_EQ(session_->process(made->frame, &result), SPHC_E_ARGUMENT);
  sphc::test::expectMentions(sphc_localizer_message(localizer()), "prior.map_id is 1");
}

// As many maps as there is memory for; the order in which they came does not change a pose.
TEST_F(CInterfaceMaps, ManyMaps) {
  config_.max_maps = SPHC_MAPS_MAX;
  config_.mode = SPHC_MODE_SINGLE;
  Session few(config_, 0.5, kRooms), many(config_, 0.5, kRooms);
  for (uint32_t id = kRooms; id < SPHC_MAPS_MAX; ++id)
    ASSERT_EQ(sphc_localizer_set_map(many.localizer(), id, many.map(0)), SPHC_OK);
  const auto made = sphc::test::sceneFrame(config_, 1, 2);
  sphc_localizer_result a = {}, b = {};
  ASSERT_EQ(few.process(made->frame, &a), SPHC_OK);
  ASSERT_EQ(many.process(made->frame, &b), SPHC_OK);
  EXPECT_EQ(a.map_id, 2u);
  EXPECT_EQ(b.map_id, 2u);
  EXPECT_EQ(std::memcmp(&a.camera_from_map, &b.camera_from_map, sizeof a.camera_from_map), 0);
  EXPECT_TRUE(many.state().guardsIntact() && many.scratch().guardsIntact());
}

}  // namespace
