// Every forbidden call of the localizer.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "tests/capi/bytes.h"
#include "tests/support/map_bytes.h"
#include "tests/support/session.h"

namespace {

using sphc::test::expectMentions;
using sphc::test::GuardedMemory;
using sphc::test::Output;
using sphc::test::Session;

class CInterfaceFailure : public testing::Test {
 protected:
  void SetUp() override {
    frame_ = sphc::test::sceneFrame(config_, 0);
    ASSERT_EQ(sphc_localizer_memory(&config_, &need_, nullptr), SPHC_OK);
    state_ = GuardedMemory(need_.state_bytes + 64, 64);
    scratch_ = GuardedMemory(need_.scratch_bytes + 64, 64);
  }

  struct Init {
    void *state, *scratch;
    size_t state_bytes, scratch_bytes;
    const sphc_localizer_config *config;
  };
  Init good() { return {state_.data(), scratch_.data(), need_.state_bytes, need_.scratch_bytes, &config_}; }
  void expectRefused(const Init &i, sphc_status expected, const char *words) {
    const std::vector<uint8_t> state = state_.copy(), scratch = scratch_.copy();
    sphc_localizer *made = nullptr;
    sphc_message message = {};
    EXPECT_EQ(sphc_localizer_init(i.state, i.state_bytes, i.scratch, i.scratch_bytes, i.config, &made, &message),
              expected);
    expectMentions(message.text, words);
    EXPECT_EQ(made, nullptr);
    EXPECT_EQ(state_.copy(), state);
    EXPECT_EQ(scratch_.copy(), scratch);
  }

  void expectFrameRefused(const sphc_localizer_frame *frame, sphc_status expected, const char *words) {
    Output<sphc_localizer_result> result;
    result->struct_size = sizeof(sphc_localizer_result);
    const std::vector<uint8_t> before(reinterpret_cast<uint8_t *>(result.get()),
                                      reinterpret_cast<uint8_t *>(result.get() + 1));
    EXPECT_EQ(sphc_localizer_process(session_.localizer(), frame, result.get()), expected) << words;
    EXPECT_EQ(std::memcmp(result.get(), before.data(), before.size()), 0) << words;
    expectMentions(sphc_localizer_message(session_.localizer()), words);
  }
  void expectFrameRefused(void (*spoil)(sphc_localizer_frame *frame), sphc_status expected, const char *words) {
    sphc_localizer_frame frame = frame_->frame;
    spoil(&frame);
    expectFrameRefused(&frame, expected, words);
  }

  sphc_localizer_config config_ = sphc::test::sceneConfig();
  Session session_{config_};
  std::unique_ptr<sphc::test::SceneFrame> frame_;
  const sphc_map *map_ = session_.map();
  sphc_memory need_ = {};
  GuardedMemory state_, scratch_;
};

TEST_F(CInterfaceFailure, InitNulls) {
  Init i = good();
  i.state = nullptr;
  expectRefused(i, SPHC_E_ARGUMENT, "state memory is null");
  i = good(), i.scratch = nullptr;
  expectRefused(i, SPHC_E_ARGUMENT, "scratch memory is null");
  i = good(), i.config = nullptr;
  expectRefused(i, SPHC_E_ARGUMENT, "config is null");
  i = good();
  sphc_message message = {};
  EXPECT_EQ(sphc_localizer_init(i.state, i.state_bytes, i.scratch, i.scratch_bytes, i.config, nullptr, &message),
            SPHC_E_ARGUMENT);
  expectMentions(message.text, "localizer is null");
}

TEST_F(CInterfaceFailure, InitMemoryTooSmall) {
  Init i = good();
  --i.state_bytes;
  expectRefused(i, SPHC_E_MEMORY_SIZE, "state memory has");
  i = good(), i.state_bytes = 0;
  expectRefused(i, SPHC_E_MEMORY_SIZE, "has 0 bytes");
  i = good(), --i.scratch_bytes;
  expectRefused(i, SPHC_E_MEMORY_SIZE, "scratch memory has");
}

TEST_F(CInterfaceFailure, InitMemoryMisaligned) {
  for (size_t off : {1u, 8u, 32u}) {
    Init i = good();
    i.state = static_cast<uint8_t *>(i.state) + off;
    expectRefused(i, SPHC_E_MEMORY_ALIGNMENT, "state memory must be aligned to 64");
    i = good(), i.scratch = static_cast<uint8_t *>(i.scratch) + off;
    expectRefused(i, SPHC_E_MEMORY_ALIGNMENT, "scratch memory must be aligned to 64");
  }
}

TEST_F(CInterfaceFailure, InitMemoryOverlaps) {
  const size_t state_end = (need_.state_bytes + 63) / 64 * 64;
  GuardedMemory both(state_end + need_.scratch_bytes + 64, 64);
  auto *begin = static_cast<uint8_t *>(both.data());
  const std::vector<uint8_t> before = both.copy();
  Init i = good();
  i.state = begin;
  for (size_t off : {size_t{0}, size_t{64}, state_end - 64}) {
    i.scratch = begin + off;
    expectRefused(i, SPHC_E_ARGUMENT, "state memory overlaps scratch");
  }
  i = good(), i.scratch = begin;
  for (size_t off : {size_t{64}, (need_.scratch_bytes - 1) / 64 * 64}) {
    i.state = begin + off;
    expectRefused(i, SPHC_E_ARGUMENT, "state memory overlaps scratch");
  }
  EXPECT_EQ(both.copy(), before);
  i = good(), i.state = begin, i.scratch = begin + state_end;  // side by side
  sphc_localizer *made = nullptr;
  EXPECT_EQ(sphc_localizer_init(i.state, i.state_bytes, i.scratch, i.scratch_bytes, i.config, &made, nullptr),
            SPHC_OK);
}

TEST_F(CInterfaceFailure, MapsThatAreNone) {
  sphc_localizer *localizer = session_.localizer();
  EXPECT_EQ(sphc_localizer_set_map(nullptr, 1, map_), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_localizer_set_map(localizer, 1, nullptr), SPHC_E_ARGUMENT);
  expectMentions(sphc_localizer_message(localizer), "map is null");
  EXPECT_EQ(sphc_localizer_set_map(localizer, SPHC_MAP_NONE, map_), SPHC_E_ARGUMENT);
  expectMentions(sphc_localizer_message(localizer), "map_id is SPHC_MAP_NONE");
  EXPECT_EQ(sphc_localizer_remove_map(nullptr, 0), SPHC_E_ARGUMENT);
  for (uint32_t id : {1u, SPHC_MAP_NONE}) {
    EXPECT_EQ(sphc_localizer_remove_map(localizer, id), SPHC_E_ARGUMENT);
    expectMentions(sphc_localizer_message(localizer), "no map with id");
  }
  EXPECT_EQ(sphc_localizer_map_count(localizer), 1u);
  EXPECT_EQ(sphc_localizer_map_count(nullptr), 0u);
}

TEST_F(CInterfaceFailure, OneMapTooMany) {
  sphc_localizer *localizer = session_.localizer();
  for (uint32_t id = 1; id < config_.max_maps; ++id)
    EXPECT_EQ(sphc_localizer_set_map(localizer, id, map_), SPHC_OK) << id;
  EXPECT_EQ(sphc_localizer_set_map(localizer, 99, map_), SPHC_E_CAPACITY);
  expectMentions(sphc_localizer_message(localizer), "has 16 maps, as many as config.max_maps");
  EXPECT_EQ(sphc_localizer_set_map(localizer, 3, map_), SPHC_OK);  // in the place of another
  EXPECT_EQ(sphc_localizer_map_count(localizer), config_.max_maps);
}

TEST_F(CInterfaceFailure, AMapInsideTheLocalizersMemory) {
  // A file and its view, each inside memory that is written.
  const std::vector<uint8_t> file = sphc::test::randomMap(50, 1);
  GuardedMemory view_memory(4096, 64);
  sphc_localizer *made = nullptr;
  const Init i = good();
  ASSERT_EQ(sphc_localizer_init(i.state, i.state_bytes, i.scratch, i.scratch_bytes, i.config, &made, nullptr),
            SPHC_OK);
  auto *inside = static_cast<uint8_t *>(i.scratch) + 1024;
  std::memcpy(inside, file.data(), file.size());
  sphc_map *view = nullptr;
  ASSERT_EQ(sphc_map_init(view_memory.data(), 4096, inside, file.size(), &view, nullptr), SPHC_OK);
  EXPECT_EQ(sphc_localizer_set_map(made, 0, view), SPHC_E_ARGUMENT);
  expectMentions(sphc_localizer_message(made), "scratch memory overlaps the file of a map");
  ASSERT_EQ(sphc_map_init(inside, 4096, file.data(), file.size(), &view, nullptr), SPHC_OK);
  EXPECT_EQ(sphc_localizer_set_map(made, 0, view), SPHC_E_ARGUMENT);
  expectMentions(sphc_localizer_message(made), "scratch memory overlaps the view of a map");
  inside = static_cast<uint8_t *>(i.state) + i.state_bytes / 128 * 64;  // a part that only frames use
  std::memcpy(inside, file.data(), file.size());
  ASSERT_EQ(sphc_map_init(view_memory.data(), 4096, inside, file.size(), &view, nullptr), SPHC_OK);
  EXPECT_EQ(sphc_localizer_set_map(made, 0, view), SPHC_E_ARGUMENT);
  expectMentions(sphc_localizer_message(made), "state memory overlaps the file of a map");
  EXPECT_EQ(sphc_localizer_map_count(made), 0u);
}

TEST_F(CInterfaceFailure, AnImageInsideTheLocalizersMemory) {
  sphc_localizer *made = nullptr;
  const Init i = good();
  ASSERT_EQ(sphc_localizer_init(i.state, i.state_bytes, i.scratch, i.scratch_bytes, i.config, &made, nullptr),
            SPHC_OK);
  sphc_localizer_result result = {};
  result.struct_size = sizeof result;
  const auto refuses = [&](const sphc_localizer_frame &frame, const char *words) {
    EXPECT_EQ(sphc_localizer_process(made, &frame, &result), SPHC_E_ARGUMENT) << words;
    expectMentions(sphc_localizer_message(made), words);
  };
  sphc_localizer_frame frame = frame_->frame;
  frame.depth.data = static_cast<uint8_t *>(i.scratch) + 64;
  refuses(frame, "scratch memory overlaps the depth image");
  frame = frame_->frame;
  frame.color.data = static_cast<uint8_t *>(i.state) + 64;
  refuses(frame, "state memory overlaps the color image");
}

TEST_F(CInterfaceFailure, AnAmplitudeImageInsideTheLocalizersMemory) {
  config_.amplitude_min = 1;
  SetUp();
  const sphc_camera &camera = config_.rig.depth_camera;
  sphc_localizer *made = nullptr;
  const Init i = good();
  ASSERT_EQ(sphc_localizer_init(i.state, i.state_bytes, i.scratch, i.scratch_bytes, i.config, &made, nullptr),
            SPHC_OK);
  sphc_localizer_frame frame = frame_->frame;
  frame.amplitude = {i.scratch, camera.width, camera.height, camera.width, SPHC_FORMAT_GRAY8};
  sphc_localizer_result result = {};
  result.struct_size = sizeof result;
  EXPECT_EQ(sphc_localizer_process(made, &frame, &result), SPHC_E_ARGUMENT);
  expectMentions(sphc_localizer_message(made), "scratch memory overlaps the amplitude image");
}

// A part of a larger image ends before the padding of its last row, and there the localizer's memory may begin.
TEST_F(CInterfaceFailure, AnImageThatEndsWhereTheStateBegins) {
  sphc_memory need = {};
  ASSERT_EQ(sphc_localizer_memory(&config_, &need, nullptr), SPHC_OK);
  const sphc_image &tight = frame_->frame.color;
  const size_t stride = tight.width + 64, image_bytes = stride * (tight.height - 1) + tight.width;
  const size_t begin = (image_bytes + need.alignment - 1) / need.alignment * need.alignment;
  GuardedMemory memory(begin + need.state_bytes, need.alignment);
  uint8_t *const state = static_cast<uint8_t *>(memory.data()) + begin, *const pixels = state - image_bytes;
  for (size_t y = 0; y < tight.height; ++y)
    std::memcpy(pixels + y * stride, static_cast<const uint8_t *>(tight.data) + y * tight.width, tight.width);
  sphc_localizer *made = nullptr;
  const Init i = good();
  ASSERT_EQ(sphc_localizer_init(state, need.state_bytes, i.scratch, i.scratch_bytes, &config_, &made, nullptr),
            SPHC_OK);
  sphc_localizer_frame frame = frame_->frame;
  frame.color.data = pixels;
  frame.color.stride_bytes = static_cast<uint32_t>(stride);
  sphc_localizer_result result = {};
  result.struct_size = sizeof result;
  EXPECT_EQ(sphc_localizer_process(made, &frame, &result), SPHC_NOT_LOCALIZED) << sphc_localizer_message(made);
  frame.color.data = pixels + 1;
  EXPECT_EQ(sphc_localizer_process(made, &frame, &result), SPHC_E_ARGUMENT);
  expectMentions(sphc_localizer_message(made), "state memory overlaps the color image");
}

TEST_F(CInterfaceFailure, ARigThatWasForgotten) {
  sphc_localizer_config config;
  ASSERT_EQ(sphc_localizer_config_init(&config, sizeof config), SPHC_OK);
  sphc_memory need = {};
  sphc_message message = {};
  EXPECT_EQ(sphc_localizer_memory(&config, &need, &message), SPHC_E_ARGUMENT);
  expectMentions(message.text, "config.rig is not set");
}

TEST_F(CInterfaceFailure, InitBadConfig) {
  sphc_localizer_config bad = config_;
  bad.struct_size = 4;
  Init i = good();
  i.config = &bad;
  expectRefused(i, SPHC_E_STRUCT_SIZE, "struct_size is 4");
  for (uint32_t maps : {0u, SPHC_MAPS_MAX + 1}) {
    bad = config_, bad.max_maps = maps;
    expectRefused(i, SPHC_E_ARGUMENT, "config.max_maps");
  }
  for (sphc_log_level level : {0, 5}) {
    bad = config_, bad.log_level = level;
    bad.log = [](void *, sphc_log_level, const char *, size_t) {};
    expectRefused(i, SPHC_E_ARGUMENT, "config.log_level");
    bad.log = nullptr;  // zeros are what was not set
    sphc_memory need = {};
    EXPECT_EQ(sphc_localizer_memory(&bad, &need, nullptr), SPHC_OK);
  }
  for (sphc_band band : {-1, 2}) {
    bad = config_, bad.color_band = band;
    expectRefused(i, SPHC_E_ARGUMENT, "config.color_band");
  }
}

TEST_F(CInterfaceFailure, Parameters) {
  sphc_localizer *localizer = session_.localizer();
  Output<double> value;
  Output<sphc_localizer_parameter_range> range;
  EXPECT_EQ(sphc_localizer_set_parameter(nullptr, SPHC_PARAMETER_PROBES, 4), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_localizer_get_parameter(nullptr, SPHC_PARAMETER_PROBES, value.get()), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_localizer_get_parameter(localizer, SPHC_PARAMETER_PROBES, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_localizer_get_parameter_range(SPHC_PARAMETER_PROBES, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_localizer_get_parameter_range(SPHC_PARAMETER_PROBES, range.get()), SPHC_E_STRUCT_SIZE);
  for (sphc_localizer_parameter unknown : {-1, 0, 5, 1000}) {
    EXPECT_EQ(sphc_localizer_set_parameter(localizer, unknown, 4), SPHC_E_UNSUPPORTED);
    expectMentions(sphc_localizer_message(localizer), ("parameter " + std::to_string(unknown)).c_str());
    EXPECT_EQ(sphc_localizer_get_parameter(localizer, unknown, value.get()), SPHC_E_UNSUPPORTED);
    EXPECT_EQ(sphc_localizer_get_parameter_range(unknown, range.get()), SPHC_E_UNSUPPORTED);
  }
  EXPECT_TRUE(value.untouched() && range.untouched());
  for (double bad : {-1.0, 2.5, 33.0, 1e300, std::nan(""), -HUGE_VAL}) {
    EXPECT_EQ(sphc_localizer_set_parameter(localizer, SPHC_PARAMETER_PROBES, bad), SPHC_E_ARGUMENT) << bad;
    expectMentions(sphc_localizer_message(localizer), "SPHC_PARAMETER_PROBES is ");
    expectMentions(sphc_localizer_message(localizer), "a whole number of 0 to 32");
  }
  EXPECT_EQ(sphc_localizer_set_parameter(localizer, SPHC_PARAMETER_MAX_RATIO, 1.5), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_localizer_get_parameter(localizer, SPHC_PARAMETER_PROBES, value.get()), SPHC_OK);
  EXPECT_EQ(*value.get(), 8);
}

TEST_F(CInterfaceFailure, DepthBiasThatCannotBe) {
  sphc_localizer_config config = config_;
  config.depth_offset_sigma_m = 0.003;
  config.depth_slope_sigma = 0.02;
  Session session(config);
  sphc_localizer_result result = {};
  ASSERT_EQ(session.process(frame_->frame, &result), SPHC_OK);
  const auto refuses = [&](void (*spoil)(sphc_depth_bias *), const char *words) {
    sphc_depth_bias depth = result.depth;
    spoil(&depth);
    EXPECT_EQ(sphc_localizer_set_depth_bias(session.localizer(), &depth), SPHC_E_ARGUMENT) << words;
    expectMentions(sphc_localizer_message(session.localizer()), words);
  };
  refuses([](sphc_depth_bias *d) { d->mid_m *= 1.01; }, "depth.mid_m");
  refuses([](sphc_depth_bias *d) { d->offset_m = std::nan(""); }, "depth.offset_m");
  refuses([](sphc_depth_bias *d) { d->slope = 0.6; }, "depth.slope");
  refuses([](sphc_depth_bias *d) { d->offset_sigma_m = 0.0031; }, "depth.offset_sigma_m");
  refuses([](sphc_depth_bias *d) { d->offset_sigma_m = 0; }, "depth.offset_sigma_m");
  refuses([](sphc_depth_bias *d) { d->slope_sigma = -0.001; }, "depth.slope_sigma");
  refuses([](sphc_depth_bias *d) { d->correlation = 1; }, "depth.correlation");
  refuses([](sphc_depth_bias *d) { d->noise_scale = 0; }, "depth.noise_scale");
  EXPECT_EQ(sphc_localizer_set_depth_bias(session.localizer(), nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_localizer_set_depth_bias(nullptr, &result.depth), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_localizer_set_depth_bias(session.localizer(), &result.depth), SPHC_OK)
      << sphc_localizer_message(session.localizer());
  sphc_depth_bias printed = result.depth;  // as a file with six digits has it
  for (double *value : {&printed.mid_m, &printed.offset_m, &printed.slope, &printed.offset_sigma_m,
                        &printed.slope_sigma, &printed.correlation, &printed.noise_scale}) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", *value);
    *value = std::atof(text);
  }
  EXPECT_EQ(sphc_localizer_set_depth_bias(session.localizer(), &printed), SPHC_OK)
      << sphc_localizer_message(session.localizer());
  // A sensor without bias, by its config.
  EXPECT_EQ(sphc_localizer_set_depth_bias(session_.localizer(), &result.depth), SPHC_E_ARGUMENT);
}

TEST_F(CInterfaceFailure, ProcessNulls) {
  sphc_localizer_result result = {};
  result.struct_size = sizeof result;
  EXPECT_EQ(sphc_localizer_process(nullptr, &frame_->frame, &result), SPHC_E_ARGUMENT);
  expectFrameRefused(static_cast<const sphc_localizer_frame *>(nullptr), SPHC_E_ARGUMENT, "frame is null");
  EXPECT_EQ(sphc_localizer_process(session_.localizer(), &frame_->frame, nullptr), SPHC_E_ARGUMENT);
  expectMentions(sphc_localizer_message(session_.localizer()), "result is null");
  EXPECT_STRNE(sphc_localizer_message(nullptr), "");
}

TEST_F(CInterfaceFailure, ProcessStructSizes) {
  expectFrameRefused([](sphc_localizer_frame *f) { f->struct_size = 0; }, SPHC_E_STRUCT_SIZE,
                     "frame.struct_size is 0");
  expectFrameRefused([](sphc_localizer_frame *f) { f->struct_size += 1; }, SPHC_E_STRUCT_SIZE, "frame.struct_size");
  Output<sphc_localizer_result> result;  // struct_size is a pattern
  EXPECT_EQ(sphc_localizer_process(session_.localizer(), &frame_->frame, result.get()), SPHC_E_STRUCT_SIZE);
  EXPECT_TRUE(result.untouched());
  expectMentions(sphc_localizer_message(session_.localizer()), "result.struct_size");
}

TEST_F(CInterfaceFailure, ReservedFieldsThatAreSet) {
  for (uint32_t sphc_localizer_config::*reserved :
       {&sphc_localizer_config::reserved, &sphc_localizer_config::reserved2, &sphc_localizer_config::reserved3}) {
    sphc_localizer_config config = config_;
    config.*reserved = 1;
    Init bad = good();
    bad.config = &config;
    expectRefused(bad, SPHC_E_UNSUPPORTED, "config has a reserved field");
  }
  expectFrameRefused([](sphc_localizer_frame *f) { f->reserved = 1; }, SPHC_E_UNSUPPORTED,
                     "frame has a reserved field");
  expectFrameRefused([](sphc_localizer_frame *f) { f->reserved2 = uint64_t{1} << 63; }, SPHC_E_UNSUPPORTED,
                     "frame has a reserved field");
  sphc_localizer_prior prior;
  sphc_localizer_prior_init(&prior, sizeof prior);
  prior.reserved = 1;
  sphc_localizer_frame frame = frame_->frame;
  frame.prior = &prior;
  expectFrameRefused(&frame, SPHC_E_UNSUPPORTED, "prior has a reserved field");
}

TEST_F(CInterfaceFailure, ProcessColorImage) {
  expectFrameRefused([](sphc_localizer_frame *f) { f->color.data = nullptr; }, SPHC_E_IMAGE,
                     "color image's data pointer is null");
  expectFrameRefused([](sphc_localizer_frame *f) { f->color.width = 319; }, SPHC_E_IMAGE, "319 x 240");
  expectFrameRefused([](sphc_localizer_frame *f) { f->color.height = 0; }, SPHC_E_IMAGE, "320 x 0");
  expectFrameRefused([](sphc_localizer_frame *f) { f->color.width = UINT32_MAX; }, SPHC_E_IMAGE, "4294967295");
  expectFrameRefused([](sphc_localizer_frame *f) { f->color.stride_bytes = 319; }, SPHC_E_IMAGE, "stride of 319");
  expectFrameRefused([](sphc_localizer_frame *f) { f->color.stride_bytes = 0; }, SPHC_E_IMAGE, "stride of 0");
  expectFrameRefused([](sphc_localizer_frame *f) { f->color.stride_bytes = UINT32_MAX; }, SPHC_E_IMAGE, "stride");
  expectFrameRefused([](sphc_localizer_frame *f) { f->color.format = SPHC_FORMAT_RGB8; }, SPHC_E_IMAGE,
                     "stride of 320");
  expectFrameRefused([](sphc_localizer_frame *f) { f->color.format = SPHC_FORMAT_DEPTH16; }, SPHC_E_IMAGE,
                     "format 10");
  expectFrameRefused([](sphc_localizer_frame *f) { f->color.format = 0; }, SPHC_E_IMAGE, "format 0");
  expectFrameRefused([](sphc_localizer_frame *f) { f->color.format = -1; }, SPHC_E_IMAGE, "format -1");
}

TEST_F(CInterfaceFailure, ProcessDepthImage) {
  expectFrameRefused([](sphc_localizer_frame *f) { f->depth.data = nullptr; }, SPHC_E_IMAGE,
                     "depth image's data pointer is null");
  expectFrameRefused(
      [](sphc_localizer_frame *f) { f->depth.data = static_cast<const uint8_t *>(f->depth.data) + 1; },
      SPHC_E_IMAGE, "not aligned");
  expectFrameRefused([](sphc_localizer_frame *f) { f->depth.stride_bytes = 401; }, SPHC_E_IMAGE, "multiple of 2");
  expectFrameRefused([](sphc_localizer_frame *f) { f->depth.stride_bytes = 398; }, SPHC_E_IMAGE, "stride of 398");
  expectFrameRefused([](sphc_localizer_frame *f) { f->depth.width = 320; }, SPHC_E_IMAGE, "320 x 160");
  expectFrameRefused([](sphc_localizer_frame *f) { f->depth.format = SPHC_FORMAT_GRAY8; }, SPHC_E_IMAGE,
                     "format 1");
}

TEST_F(CInterfaceFailure, TheNextFrameGoesOn) {
  expectFrameRefused([](sphc_localizer_frame *f) { f->color.data = nullptr; }, SPHC_E_IMAGE, "null");
  sphc_localizer_result result = {};
  EXPECT_EQ(session_.process(frame_->frame, &result), SPHC_OK);
  EXPECT_STREQ(sphc_localizer_message(session_.localizer()), "");
}

TEST_F(CInterfaceFailure, Observations) {
  Output<uint32_t> count;
  sphc_localizer_observation one;
  EXPECT_EQ(sphc_localizer_observations(nullptr, &one, sizeof one, 1, count.get()), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_localizer_observations(session_.localizer(), &one, sizeof one, 1, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_localizer_observations(session_.localizer(), nullptr, sizeof one, 1, count.get()),
            SPHC_E_ARGUMENT);
  constexpr uint32_t kFirst = offsetof(sphc_localizer_observation, camera);  // what 0.2.0 published
  for (uint32_t stride : {0u, kFirst - 4, uint32_t{sizeof one} + 1})
    EXPECT_EQ(sphc_localizer_observations(session_.localizer(), &one, stride, 1, count.get()), SPHC_E_ARGUMENT);
  EXPECT_TRUE(count.untouched());
}

}  // namespace
