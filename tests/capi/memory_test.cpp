// sphc_localizer_config_init, sphc_localizer_memory and sphc_localizer_memory_piece.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "tests/capi/bytes.h"
#include "tests/support/session.h"

namespace {

using sphc::test::expectMentions;
using sphc::test::Output;

TEST(CInterfaceConfig, InitRefuses) {
  EXPECT_EQ(sphc_localizer_config_init(nullptr, sizeof(sphc_localizer_config)), SPHC_E_ARGUMENT);
  Output<sphc_localizer_config> config;
  for (size_t size : {size_t{0}, offsetof(sphc_localizer_config, depth_format) - 8,
                      sizeof(sphc_localizer_config) + 1, size_t{8192}})
    EXPECT_EQ(sphc_localizer_config_init(config.get(), size), SPHC_E_STRUCT_SIZE);
  EXPECT_TRUE(config.untouched());
}

TEST(CInterfaceConfig, DefaultsNeedOnlyCameras) {
  sphc_localizer_config config;
  ASSERT_EQ(sphc_localizer_config_init(&config, sizeof config), SPHC_OK);
  sphc_memory need;
  sphc_message message;
  EXPECT_EQ(sphc_localizer_memory(&config, &need, &message), SPHC_E_ARGUMENT);
  expectMentions(message.text, "config.rig is not set");
  config.rig.depth_camera = sphc::test::pinhole(640, 480, 500);
  EXPECT_EQ(sphc_localizer_memory(&config, &need, &message), SPHC_E_ARGUMENT);
  expectMentions(message.text, "color_camera");
  config.rig.color_camera = config.rig.depth_camera = sphc::test::pinhole(640, 480, 500);
  EXPECT_EQ(sphc_localizer_memory(&config, &need, &message), SPHC_OK);
}

struct Spoiled {
  const char *words;  // that the message must have
  void (*spoil)(sphc_localizer_config *config);
};
const double kNotANumber = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();

void logNothing(void *, sphc_log_level, const char *, size_t) {}
void runNothing(void *, uint32_t, sphc_task_fn, void *) {}

const Spoiled kSpoiled[] = {
    {"max_keypoints is 63", [](sphc_localizer_config *c) { c->max_keypoints = 63; }},
    {"max_keypoints is 4097", [](sphc_localizer_config *c) { c->max_keypoints = 4097; }},
    {"max_maps is 0", [](sphc_localizer_config *c) { c->max_maps = 0; }},
    {"max_maps is 65", [](sphc_localizer_config *c) { c->max_maps = 65; }},
    {"log_level is 0", [](sphc_localizer_config *c) { c->log = logNothing, c->log_level = 0; }},
    {"color_camera.model is 0", [](sphc_localizer_config *c) { c->rig.color_camera.model = 0; }},
    {"depth_camera.model is 0", [](sphc_localizer_config *c) { c->rig.depth_camera.model = 0; }},
    {"color_camera", [](sphc_localizer_config *c) { c->rig.color_camera.params[0] = kNotANumber; }},
    {"depth_camera", [](sphc_localizer_config *c) { c->rig.depth_camera.params[3] = kInf; }},
    {"depth_camera", [](sphc_localizer_config *c) { c->rig.depth_camera.width = 8193; }},
    {"color_from_depth", [](sphc_localizer_config *c) { c->rig.color_from_depth.q_wxyz[0] = 0; }},
    {"color_from_depth", [](sphc_localizer_config *c) { c->rig.color_from_depth.q_wxyz[1] = kNotANumber; }},
    {"color_from_depth", [](sphc_localizer_config *c) { c->rig.color_from_depth.t_m[2] = kInf; }},
    {"depth_unit_m", [](sphc_localizer_config *c) { c->rig.depth_unit_m = 0; }},
    {"depth_unit_m is nan", [](sphc_localizer_config *c) { c->rig.depth_unit_m = kNotANumber; }},
    {"depth_min_m", [](sphc_localizer_config *c) { c->depth_min_m = 0; }},
    {"depth_min_m", [](sphc_localizer_config *c) { c->depth_min_m = kNotANumber; }},
    {"depth_max_m", [](sphc_localizer_config *c) { c->depth_max_m = c->depth_min_m; }},
    {"depth_max_m is inf", [](sphc_localizer_config *c) { c->depth_max_m = kInf; }},
    {"depth_sigma_m", [](sphc_localizer_config *c) { c->depth_sigma_m = 0; }},
    {"depth_sigma_m", [](sphc_localizer_config *c) { c->depth_sigma_m = kNotANumber; }},
    {"depth_sigma_per_m2", [](sphc_localizer_config *c) { c->depth_sigma_per_m2 = -0.1; }},
    {"depth_sigma_per_m2", [](sphc_localizer_config *c) { c->depth_sigma_per_m2 = kNotANumber; }},
    {"pixel_sigma_px", [](sphc_localizer_config *c) { c->pixel_sigma_px = 0; }},
    {"pixel_sigma_px", [](sphc_localizer_config *c) { c->pixel_sigma_px = kInf; }},
    {"map_sigma_m", [](sphc_localizer_config *c) { c->map_sigma_m = -1; }},
    {"map_sigma_m", [](sphc_localizer_config *c) { c->map_sigma_m = kNotANumber; }},
    {"parallel_tasks is 0", [](sphc_localizer_config *c) { c->parallel = runNothing; }},
    {"parallel_tasks is 9; it must lie in 1 to 8",
     [](sphc_localizer_config *c) { c->parallel = runNothing, c->parallel_tasks = SPHC_PARALLEL_MAX + 1; }},
    {"parallel_tasks is 2, but config.parallel is null", [](sphc_localizer_config *c) { c->parallel_tasks = 2; }},
    {"set parallel_tasks to 0", [](sphc_localizer_config *c) { c->parallel_tasks = 1; }},
};

TEST(CInterfaceConfig, EveryBadFieldIsNamed) {
  for (const Spoiled &spoiled : kSpoiled) {
    sphc_localizer_config config = sphc::test::sceneConfig();
    spoiled.spoil(&config);
    Output<sphc_memory> need;
    sphc_message message = {};
    EXPECT_EQ(sphc_localizer_memory(&config, need.get(), &message), SPHC_E_ARGUMENT) << spoiled.words;
    expectMentions(message.text, spoiled.words);
    EXPECT_TRUE(need.untouched());
    EXPECT_EQ(sphc_localizer_memory(&config, need.get(), nullptr), SPHC_E_ARGUMENT);
    Output<sphc_memory_piece> piece;
    EXPECT_EQ(sphc_localizer_memory_piece(&config, 0, piece.get()), SPHC_E_ARGUMENT);
    EXPECT_TRUE(piece.untouched());
  }
}

TEST(CInterfaceConfig, NullAndStructSize) {
  sphc_localizer_config config = sphc::test::sceneConfig();
  Output<sphc_memory> need;
  sphc_message message = {};
  EXPECT_EQ(sphc_localizer_memory(nullptr, need.get(), &message), SPHC_E_ARGUMENT);
  expectMentions(message.text, "config is null");
  EXPECT_EQ(sphc_localizer_memory(&config, nullptr, &message), SPHC_E_ARGUMENT);
  expectMentions(message.text, "memory is null");
  for (uint32_t size : {0u, 8u, static_cast<uint32_t>(sizeof config) + 1}) {
    config.struct_size = size;
    EXPECT_EQ(sphc_localizer_memory(&config, need.get(), &message), SPHC_E_STRUCT_SIZE);
    expectMentions(message.text, "sizeof(sphc_localizer_config)");
  }
  EXPECT_TRUE(need.untouched());
}

TEST(CInterfaceMemory, PiecesAddUpToTheWhole) {
  for (uint32_t keypoints : {64u, 400u, 4096u}) {
    sphc_localizer_config config = sphc::test::sceneConfig();
    config.max_keypoints = keypoints;
    sphc_memory need;
    ASSERT_EQ(sphc_localizer_memory(&config, &need, nullptr), SPHC_OK);
    size_t sum[2] = {};
    sphc_memory_piece piece;
    uint32_t index = 0;
    for (; sphc_localizer_memory_piece(&config, index, &piece) == SPHC_OK; ++index) {
      ASSERT_LE(piece.scratch, 1u);
      EXPECT_GT(std::strlen(piece.name), 3u);
      EXPECT_EQ(piece.bytes % need.alignment, 0u);
      sum[piece.scratch] += piece.bytes;
    }
    EXPECT_GT(index, 10u);
    EXPECT_EQ(sphc_localizer_memory_piece(&config, index, &piece), SPHC_END);
    EXPECT_EQ(sphc_localizer_memory_piece(&config, UINT32_MAX, &piece), SPHC_END);
    EXPECT_EQ(sum[0], need.state_bytes);
    EXPECT_EQ(sum[1], need.scratch_bytes);
  }
}

TEST(CInterfaceMemory, GrowsWithWhatIsAskedFor) {
  sphc_localizer_config config = sphc::test::sceneConfig();
  sphc_memory small, more_keypoints, larger_image;
  sphc_localizer_memory(&config, &small, nullptr);
  config.max_keypoints *= 2;
  sphc_localizer_memory(&config, &more_keypoints, nullptr);
  config.rig.color_camera.width *= 2;
  sphc_localizer_memory(&config, &larger_image, nullptr);
  EXPECT_LT(small.scratch_bytes, more_keypoints.scratch_bytes);
  EXPECT_LT(more_keypoints.scratch_bytes, larger_image.scratch_bytes);
  EXPECT_LT(small.state_bytes, more_keypoints.state_bytes);
}

// Upper bounds for static buffers hold for every camera and are not wasteful where it matters.
TEST(CInterfaceMemory, BoundsHold) {
  sphc_localizer_config config = sphc::test::sceneConfig();
  for (uint32_t width : {16u, 17u, 64u, 320u, 641u, 1280u, 1920u, 8192u})
    for (uint32_t height : {16u, 48u, 240u, 481u, 960u, 1080u, 8192u})
      for (uint32_t depth_size : {16u, 1024u, 8192u})
        for (uint32_t keypoints : {64u, 800u, 4096u})
          for (uint32_t maps : {1u, 16u, SPHC_MAPS_MAX}) {
            config.rig.color_camera = sphc::test::pinhole(width, height, 500);
            config.rig.depth_camera = sphc::test::pinhole(depth_size, depth_size, 500);
            config.max_keypoints = keypoints;
            config.max_maps = maps;
            sphc_memory need = {};
            ASSERT_EQ(sphc_localizer_memory(&config, &need, nullptr), SPHC_OK);
            ASSERT_LE(need.state_bytes, SPHC_LOCALIZER_STATE_BYTES_MAX(keypoints, maps));
            ASSERT_LE(need.scratch_bytes, SPHC_LOCALIZER_SCRATCH_BYTES_MAX(keypoints, width, height))
                << width << " x " << height << ", " << keypoints;
            if (width == 1280 && height == 960) {
              EXPECT_LE(SPHC_LOCALIZER_SCRATCH_BYTES_MAX(keypoints, width, height), need.scratch_bytes * 3 / 2);
            }
          }
}

// The extremes of the config can be asked about, whatever the machine has.
TEST(CInterfaceMemory, LargestConfig) {
  sphc_localizer_config config = sphc::test::sceneConfig();
  config.rig.color_camera = sphc::test::pinhole(8192, 8192, 4000);
  config.max_keypoints = 4096;
  sphc_memory need;
  EXPECT_EQ(sphc_localizer_memory(&config, &need, nullptr), SPHC_OK);
  EXPECT_GT(need.scratch_bytes, size_t{8192} * 8192);
  config.rig.color_camera = config.rig.depth_camera = sphc::test::pinhole(16, 16, 10);
  config.max_keypoints = 64;
  EXPECT_EQ(sphc_localizer_memory(&config, &need, nullptr), SPHC_OK);
}

}  // namespace
