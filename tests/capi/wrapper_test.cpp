// What spherecloud.hpp adds to the C interface: the caller's memory, defaults, and answers without a raw call.
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "spherecloud/spherecloud.hpp"
#include "tests/capi/bytes.h"
#include "tests/support/map_bytes.h"
#include "tests/support/session.h"

namespace {

using sphc::test::expectMentions;
using sphc::test::GuardedMemory;
using spherecloud::Aligner;
using spherecloud::Features;
using spherecloud::Localizer;
using spherecloud::Map;
using spherecloud::Status;

GuardedMemory stateOf(const sphc_memory &need) { return GuardedMemory(need.state_bytes, need.alignment); }

template <typename T>
uint32_t sizeToldBy(const T &made) {
  return made.struct_size;
}

TEST(Wrapper, AbiIsTheHeaders) { EXPECT_TRUE(spherecloud::checkAbi().ok()); }

TEST(Wrapper, EverythingLivesInTheCallersMemory) {
  const sphc_localizer_config config = sphc::test::sceneConfig();
  const std::vector<uint8_t> file = sphc::test::makeSceneMap(config.rig.color_camera, 800, 4, 0.5).file;
  sphc_memory need = {}, features_need = {}, map_need = {};
  ASSERT_TRUE(Localizer::memory(config, &need).ok());
  ASSERT_TRUE(Features::memory(config, &features_need).ok());
  ASSERT_TRUE(Map::memory(&map_need).ok());
  GuardedMemory state = stateOf(need), features_memory = stateOf(features_need), map_memory = stateOf(map_need),
                scratch(need.scratch_bytes, need.alignment);
  {
    Localizer localizer;
    Features features;
    Map map;
    ASSERT_TRUE(Map::open(map_memory.data(), map_memory.size(), file.data(), file.size(), &map).ok());
    ASSERT_TRUE(
        Localizer::make(config, state.data(), state.size(), scratch.data(), scratch.size(), &localizer).ok());
    ASSERT_TRUE(Features::make(config, features_memory.data(), features_memory.size(), &features).ok());
    ASSERT_TRUE(localizer.setMap(3, map).ok());
    const auto scene = sphc::test::sceneFrame(config, 1);
    sphc_localizer_result result = spherecloud::emptyResult();
    ASSERT_TRUE(localizer.extract(scene->frame, &features).ok());
    ASSERT_TRUE(localizer.locate(scene->frame, features, &result).ok());
    EXPECT_EQ(result.map_id, 3u);
    EXPECT_EQ(spherecloud::confidenceWithin(result, 0, 0.1), 0);
    EXPECT_GT(spherecloud::confidenceWithin(result, 1, 0.5), 0.5);
  }
  for (const GuardedMemory *memory : {&state, &scratch, &features_memory, &map_memory})
    EXPECT_TRUE(memory->guardsIntact());
}

TEST(Wrapper, AlignerLivesInTheCallersMemory) {
  sphc_aligner_config config = spherecloud::defaultAlignerConfig();
  sphc_memory need = {};
  expectMentions(Aligner::memory(config, &need).text(), "config.rig is not set");
  config.rig = sphc::test::sceneConfig().rig;
  ASSERT_TRUE(Aligner::memory(config, &need).ok());
  GuardedMemory memory = stateOf(need);
  Aligner aligner;
  expectMentions(Aligner::make(config, memory.data(), memory.size() - 1, &aligner).text(), "aligner memory has");
  EXPECT_FALSE(aligner);
  ASSERT_TRUE(Aligner::make(config, memory.data(), memory.size(), &aligner).ok());
  EXPECT_EQ(static_cast<void *>(aligner.get()), memory.data());
  const auto scene = sphc::test::sceneFrame(sphc::test::sceneConfig(), 0);
  std::vector<uint16_t> depth(size_t{config.rig.color_camera.width} * config.rig.color_camera.height);
  EXPECT_TRUE(
      aligner.process(scene->frame.depth, spherecloud::aligned(config.rig.color_camera.width, depth.data())).ok());
  EXPECT_TRUE(memory.guardsIntact());
}

TEST(Wrapper, TooLittleMemoryIsSaid) {
  const sphc_localizer_config config = sphc::test::sceneConfig();
  sphc_memory need = {};
  ASSERT_TRUE(Features::memory(config, &need).ok());
  GuardedMemory memory = stateOf(need);
  Features features;
  const Status status = Features::make(config, memory.data(), memory.size() - 1, &features);
  EXPECT_EQ(status.code(), SPHC_E_MEMORY_SIZE);
  expectMentions(status.text(), "features memory has");
  EXPECT_FALSE(features);
}

TEST(Wrapper, ParametersAreReadBack) {
  Localizer localizer, none;
  ASSERT_TRUE(Localizer::make(sphc::test::sceneConfig(), &localizer).ok());
  sphc_localizer_parameter_range range = {};
  double value = 0;
  ASSERT_TRUE(Localizer::parameterRange(SPHC_PARAMETER_PROBES, &range).ok());
  ASSERT_TRUE(localizer.parameter(SPHC_PARAMETER_PROBES, &value).ok());
  EXPECT_EQ(value, range.initial);
  ASSERT_TRUE(localizer.setParameter(SPHC_PARAMETER_PROBES, range.highest).ok());
  ASSERT_TRUE(localizer.parameter(SPHC_PARAMETER_PROBES, &value).ok());
  EXPECT_EQ(value, range.highest);
  EXPECT_EQ(localizer.parameter(99, &value).code(), SPHC_E_UNSUPPORTED);
  EXPECT_EQ(Localizer::parameterRange(99, &range).code(), SPHC_E_UNSUPPORTED);
  EXPECT_EQ(none.parameter(SPHC_PARAMETER_PROBES, &value).code(), SPHC_E_ARGUMENT);
}

TEST(Wrapper, MapsAreCountedAndPlaced) {
  const std::vector<uint8_t> file = sphc::test::randomMap(50, 1);
  Localizer localizer, none;
  Map map;
  ASSERT_TRUE(Map::open(file.data(), file.size(), &map).ok());
  std::array<double, 3> direction = {};
  EXPECT_TRUE(map.direction(49, &direction).ok());
  EXPECT_NE(direction[0], 0);
  EXPECT_EQ(map.direction(50, &direction).code(), SPHC_E_ARGUMENT);
  ASSERT_TRUE(Localizer::make(sphc::test::sceneConfig(), &localizer).ok());
  EXPECT_EQ(localizer.mapCount(), 0u);
  ASSERT_TRUE(localizer.setMap(7, map).ok());
  EXPECT_EQ(localizer.mapCount(), 1u);
  EXPECT_EQ(none.mapCount(), 0u);
  EXPECT_TRUE(localizer.setMapTransform(7, spherecloud::identity(), 0.01, 0.1).ok());
  EXPECT_TRUE(localizer.removeMapTransform(7).ok());
  expectMentions(localizer.removeMapTransform(8).text(), "no map with id 8");
  expectMentions(localizer.removeMap(8).text(), "no map with id 8");
  EXPECT_EQ(localizer.mapCount(), 1u);
  EXPECT_TRUE(localizer.removeMap(7).ok());
  EXPECT_EQ(localizer.mapCount(), 0u);
  EXPECT_EQ(none.removeMap(7).code(), SPHC_E_ARGUMENT);
}

TEST(Wrapper, DepthBiasIsKnownFromBefore) {
  sphc_localizer_config config = sphc::test::sceneConfig();
  config.depth_offset_sigma_m = 0.003;
  config.depth_slope_sigma = 0.02;
  const std::vector<uint8_t> file = sphc::test::makeSceneMap(config.rig.color_camera, 800, 4, 0.5).file;
  Localizer localizer, none;
  Map map;
  ASSERT_TRUE(Map::open(file.data(), file.size(), &map).ok());
  ASSERT_TRUE(Localizer::make(config, map, &localizer).ok());
  const auto scene = sphc::test::sceneFrame(config, 1);
  sphc_localizer_result result = spherecloud::emptyResult();
  ASSERT_TRUE(localizer.process(scene->frame, &result).ok());
  sphc_depth_bias known = result.depth;
  known.offset_m = 0.002;
  known.offset_sigma_m = 1e-6;
  EXPECT_TRUE(localizer.setDepthBias(known).ok());
  ASSERT_TRUE(localizer.process(scene->frame, &result).ok());
  EXPECT_NEAR(result.depth.offset_m, 0.002, 1e-4);
  known.slope = 0.6;
  expectMentions(localizer.setDepthBias(known).text(), "depth.slope");
  EXPECT_EQ(none.setDepthBias(known).code(), SPHC_E_ARGUMENT);
}

TEST(Wrapper, CamerasAreMadeAndChecked) {
  const sphc_camera camera = spherecloud::camera(SPHC_CAMERA_PINHOLE, 640, 480, {500, 500, 320, 240});
  EXPECT_TRUE(spherecloud::checkCamera(camera).ok());
  expectMentions(spherecloud::checkCamera(spherecloud::camera(SPHC_CAMERA_PINHOLE, 640, 480, {500, 500})).text(),
                 "camera.param_count is 2; model 1 takes 4");
  sphc_rig rig = spherecloud::defaultRig();
  expectMentions(spherecloud::checkRig(rig).text(), "color_camera.model is 0");
  rig.color_camera = rig.depth_camera = camera;
  EXPECT_TRUE(spherecloud::checkRig(rig).ok());
}

TEST(Wrapper, PointsArePixelsAndBearings) {
  const sphc_camera camera = spherecloud::camera(SPHC_CAMERA_PINHOLE, 640, 480, {500, 500, 320, 240});
  std::array<double, 2> pixel_px = {};
  std::array<double, 3> bearing = {};
  ASSERT_TRUE(spherecloud::project(camera, {0.2, -0.1, 2}, &pixel_px).ok());
  EXPECT_DOUBLE_EQ(pixel_px[0], 370);
  EXPECT_DOUBLE_EQ(pixel_px[1], 215);
  ASSERT_TRUE(spherecloud::unproject(camera, {320, 240}, &bearing).ok());
  EXPECT_DOUBLE_EQ(bearing[2], 1);
  EXPECT_EQ(spherecloud::project(camera, {0, 0, -1}, &pixel_px).code(), SPHC_OUTSIDE);
  const sphc_rigid moved = {{1, 0, 0, 0}, {1, 2, 3}};
  EXPECT_EQ(spherecloud::apply(moved, {1, 1, 1}), (std::array<double, 3>{2, 3, 4}));
}

TEST(Wrapper, WhatIsEmptyCanBeGiven) {
  EXPECT_EQ(sizeToldBy(spherecloud::emptyFrame()), sizeof(sphc_localizer_frame));
  EXPECT_EQ(sizeToldBy(spherecloud::emptyView()), sizeof(sphc_localizer_view));
  EXPECT_EQ(sizeToldBy(spherecloud::emptyDepthView()), sizeof(sphc_localizer_depth_view));
  EXPECT_EQ(spherecloud::emptyPrior().camera_from_map.q_wxyz[0], 1);
  EXPECT_EQ(spherecloud::defaultCamera().color_from_camera.q_wxyz[0], 1);
  EXPECT_EQ(spherecloud::defaultDepthCamera().unit_m, 0.001);
  Localizer localizer;
  const sphc_localizer_config config = sphc::test::sceneConfig();
  ASSERT_TRUE(Localizer::make(config, &localizer).ok());
  const auto scene = sphc::test::sceneFrame(config, 0);
  const sphc_localizer_prior prior = spherecloud::emptyPrior();
  sphc_localizer_frame frame = spherecloud::emptyFrame();
  frame.color = scene->frame.color;
  frame.depth = scene->frame.depth;
  frame.prior = &prior;
  sphc_localizer_result result = spherecloud::emptyResult();
  EXPECT_EQ(localizer.process(frame, &result).code(), SPHC_NOT_LOCALIZED);  // it has no map
}

}  // namespace
