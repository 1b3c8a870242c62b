// Maps that come and go between frames.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>

#include "tests/capi/bytes.h"
#include "tests/support/map_bytes.h"
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

// A camera of one band and maps of both.
class CInterfaceBands : public testing::Test {
 protected:
  // Status of a localizer that is given a map, and what it says.
  sphc_status give(sphc_band camera, sphc_band map_band, sphc_localizer_config config = sphc::test::sceneConfig()) {
    config.color_band = camera;
    sphc_memory need = {};
    EXPECT_EQ(sphc_localizer_memory(&config, &need, nullptr), SPHC_OK);
    GuardedMemory state(need.state_bytes, need.alignment), scratch(need.scratch_bytes, need.alignment),
        view(SPHC_MAP_BYTES_MAX, 64);
    std::vector<uint8_t> file = sphc::test::randomMap(50, 1);
    sphc::test::setBand(&file, static_cast<uint32_t>(map_band));
    sphc_map *map = nullptr;
    EXPECT_EQ(sphc_map_init(view.data(), view.size(), file.data(), file.size(), &map, nullptr), SPHC_OK);
    sphc_localizer *localizer = nullptr;
    EXPECT_EQ(sphc_localizer_init(state.data(), state.size(), scratch.data(), scratch.size(), &config, &localizer,
                                  nullptr),
              SPHC_OK);
    const sphc_status status = sphc_localizer_set_map(localizer, 0, map);
    said_ = sphc_localizer_message(localizer);
    EXPECT_EQ(sphc_localizer_map_count(localizer), status == SPHC_OK ? 1u : 0u);
    return status;
  }

  std::string said_;
};

TEST_F(CInterfaceBands, AMapOfAnotherBandIsRefused) {
  EXPECT_EQ(give(SPHC_BAND_VISIBLE, SPHC_BAND_VISIBLE), SPHC_OK);
  EXPECT_EQ(give(SPHC_BAND_INFRARED, SPHC_BAND_INFRARED), SPHC_OK);
  for (sphc_band camera : {SPHC_BAND_VISIBLE, SPHC_BAND_INFRARED}) {
    const sphc_band other = SPHC_BAND_INFRARED - camera;
    EXPECT_EQ(give(camera, other), SPHC_E_ARGUMENT);
    EXPECT_NE(said_.find(std::string("map is of ") + sphc_band_name(other)), std::string::npos) << said_;
    EXPECT_NE(said_.find(std::string("color_band is ") + sphc_band_name(camera)), std::string::npos) << said_;
    EXPECT_LT(said_.size(), SPHC_MESSAGE_BYTES - 1) << "cut short";
  }
}

TEST_F(CInterfaceBands, AProgramFromBeforeHasAVisibleCamera) {
  sphc_localizer_config config = sphc::test::sceneConfig();
  config.struct_size = offsetof(sphc_localizer_config, color_band);
  EXPECT_EQ(give(SPHC_BAND_INFRARED, SPHC_BAND_VISIBLE, config), SPHC_OK);  // the field lies behind its struct
  EXPECT_EQ(give(SPHC_BAND_INFRARED, SPHC_BAND_INFRARED, config), SPHC_E_ARGUMENT);
}

// The rooms lie over each other, so that a viewpoint is at the same place in all of them.
class CInterfaceMapTransforms : public CInterfaceMaps {
 protected:
  sphc_rigid commonFrom(uint32_t room) const {
    const auto &centre = session_->sceneMap(room).centre_in_world_m;
    const sphc_rigid turned = {{0.8, 0, 0.6, 0}, {3, -2, 1}},
                     world_from_map = {{1, 0, 0, 0}, {centre[0], centre[1], centre[2]}};
    sphc_rigid common_from_map;
    sphc_rigid_compose(&turned, &world_from_map, &common_from_map);
    return common_from_map;
  }
  void place(uint32_t room, double off_m = 0) {
    sphc_rigid common_from_map = commonFrom(room);
    common_from_map.t_m[0] += off_m;
    ASSERT_EQ(sphc_localizer_set_map_transform(localizer(), room, &common_from_map, 0.002, 0.01), SPHC_OK);
  }
  void expectRefused(uint32_t map_id, const sphc_rigid &common_from_map, double turn, double shift,
                     const char *words) {
    EXPECT_EQ(sphc_localizer_set_map_transform(localizer(), map_id, &common_from_map, turn, shift),
              SPHC_E_ARGUMENT);
    sphc::test::expectMentions(sphc_localizer_message(localizer()), words);
  }
  // The first frame in the next room.
  sphc_localizer_result goThrough() {
    for (uint32_t viewpoint : {0u, 1u, 2u}) see(viewpoint, 2);
    return see(3, 1);
  }
};

TEST_F(CInterfaceMapTransforms, HandOverWithoutAJump) {
  for (uint32_t room = 0; room < kRooms; ++room) place(room);
  const sphc_localizer_result moved = goThrough();
  EXPECT_EQ(moved.outcome, SPHC_OUTCOME_LOCALIZED);
  EXPECT_EQ(moved.map_id, 1u);
  EXPECT_EQ(moved.state, SPHC_STATE_TRACKING);
  EXPECT_EQ(moved.guided, 1u);
  EXPECT_EQ(moved.events, uint32_t{SPHC_EVENT_MAP_CHANGED});
  EXPECT_GT(moved.jump_m, 0);
  EXPECT_LT(moved.jump_m, 0.03);
  EXPECT_LT(moved.jump_rad, 0.02);
  const sphc_localizer_result next = see(4, 1);
  EXPECT_EQ(next.state, SPHC_STATE_TRACKING);
  EXPECT_EQ(next.guided, 1u);
  EXPECT_EQ(next.events, 0u);
}

TEST_F(CInterfaceMapTransforms, AWrongOneShowsAsAJump) {
  place(1, 1.0), place(2);
  const sphc_localizer_result moved = goThrough();
  EXPECT_EQ(moved.outcome, SPHC_OUTCOME_LOCALIZED);
  EXPECT_EQ(moved.state, SPHC_STATE_LOST);
  EXPECT_EQ(moved.guided, 0u);
  EXPECT_EQ(moved.events, uint32_t{SPHC_EVENT_MAP_CHANGED | SPHC_EVENT_JUMPED});
  EXPECT_NEAR(moved.jump_m, 1, 0.05);
  EXPECT_EQ(see(4, 1).state, SPHC_STATE_TRACKING);
}

TEST_F(CInterfaceMapTransforms, OneAloneSaysNothing) {
  place(1), place(2);
  ASSERT_EQ(sphc_localizer_set_map_transform(localizer(), 1, nullptr, 0, 0), SPHC_OK);
  const sphc_localizer_result moved = goThrough();
  EXPECT_EQ(moved.outcome, SPHC_OUTCOME_LOCALIZED);
  EXPECT_EQ(moved.state, SPHC_STATE_LOST);
  EXPECT_EQ(moved.guided, 0u);
  EXPECT_EQ(moved.events, uint32_t{SPHC_EVENT_MAP_CHANGED});
  EXPECT_EQ(moved.jump_m, 0);
}

TEST_F(CInterfaceMapTransforms, ANewReleaseKeepsIt) {
  place(1), place(2);
  ASSERT_EQ(sphc_localizer_set_map(localizer(), 1, session_->map(1)), SPHC_OK);
  EXPECT_EQ(goThrough().state, SPHC_STATE_TRACKING);
}

TEST_F(CInterfaceMapTransforms, Refused) {
  const double nan = std::nan("");
  const sphc_rigid fine = commonFrom(1);
  sphc_rigid bad = fine;
  EXPECT_EQ(sphc_localizer_set_map_transform(nullptr, 1, &fine, 0, 0), SPHC_E_ARGUMENT);
  expectRefused(9, fine, 0.01, 0.01, "no map with id 9");
  EXPECT_EQ(sphc_localizer_set_map_transform(localizer(), 9, nullptr, 0, 0), SPHC_E_ARGUMENT);
  for (const double sigma : {-1e-9, 101.0, nan, HUGE_VAL}) {
    expectRefused(1, fine, sigma, 0.01, "rotation_sigma_rad is");
    expectRefused(1, fine, 0.01, sigma, "translation_sigma_m is");
  }
  bad.q_wxyz[0] = 2;
  expectRefused(1, bad, 0.01, 0.01, "common_from_map.q_wxyz has length 2.0");
  bad = fine, bad.t_m[2] = nan;
  expectRefused(1, bad, 0.01, 0.01, "common_from_map.t_m[2] is nan");
  bad = fine, bad.t_m[1] = 2e4;
  expectRefused(1, bad, 0.01, 0.01, "common_from_map.t_m[1] is 20000; it must lie in -10000 to 10000");
  place(2);  // what was refused left nothing behind
  EXPECT_EQ(goThrough().state, SPHC_STATE_LOST);
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
  prior.flags = SPHC_PRIOR_UP;
  prior.up_camera[1] = prior.up_map[1] = 1;
  prior.up_sigma_rad = 0.01;
  EXPECT_EQ(session_->process(made->frame, &result), SPHC_E_ARGUMENT);
  prior.flags = SPHC_PRIOR_ODOMETRY;  // which is of no map
  prior.odometry_from_camera = found.camera_from_map;
  prior.odometry_rotation_sigma_rad = prior.odometry_translation_sigma_m = 0.01;
  EXPECT_EQ(session_->process(made->frame, &result), SPHC_NOT_LOCALIZED);
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
