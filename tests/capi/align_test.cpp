#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "spherecloud/spherecloud.hpp"
#include "tests/capi/bytes.h"
#include "tests/support/session.h"

namespace {

using sphc::test::expectMentions;
using sphc::test::GuardedMemory;
using sphc::test::Output;

constexpr uint32_t kWidth = 64, kHeight = 48;

class CInterfaceAligner : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(sphc_aligner_config_init(&config_, sizeof config_), SPHC_OK);
    config_.rig.color_camera = sphc::test::pinhole(kWidth, kHeight, 50);
    config_.rig.depth_camera = sphc::test::pinhole(40, 30, 30);
    config_.rig.color_from_depth.t_m[0] = -0.05;
    sphc_memory need = {};
    ASSERT_EQ(sphc_aligner_memory(&config_, &need, &message_), SPHC_OK);
    bytes_ = need.state_bytes;
    memory_ = GuardedMemory(bytes_, need.alignment);
    raw_.assign(40 * 30, 1500);
  }
  sphc_status init() { return sphc_aligner_init(memory_.data(), bytes_, &config_, &aligner_, &message_); }
  sphc_image image() const { return {raw_.data(), 40, 30, 80, SPHC_FORMAT_DEPTH16}; }

  sphc_aligner_config config_ = {};
  size_t bytes_ = 0;
  GuardedMemory memory_;
  std::vector<uint16_t> raw_;
  sphc_aligner *aligner_ = nullptr;
  sphc_message message_ = {};
};

TEST_F(CInterfaceAligner, AlignsIntoStridedImages) {
  ASSERT_EQ(init(), SPHC_OK);
  constexpr uint32_t kPad = 3;
  std::vector<uint16_t> depth((kWidth + kPad) * kHeight, 7);
  std::vector<uint8_t> mask((kWidth + kPad) * kHeight, 7), confidence = mask;
  const sphc_aligned aligned = {sizeof aligned, 2 * (kWidth + kPad), kWidth + kPad,    kWidth + kPad,
                                depth.data(),   mask.data(),         confidence.data()};
  const sphc_image raw = image();
  ASSERT_EQ(sphc_aligner_process(aligner_, &raw, &aligned), SPHC_OK);
  EXPECT_STREQ(sphc_aligner_message(aligner_), "");
  int with_depth = 0;
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = 0; x < kWidth + kPad; ++x) {
      const size_t at = y * (kWidth + kPad) + x;
      if (x >= kWidth) {  // between the rows: not ours
        EXPECT_EQ(depth[at], 7);
        EXPECT_EQ(mask[at], 7);
        EXPECT_EQ(confidence[at], 7);
        continue;
      }
      const bool has = mask[at] == SPHC_ALIGNED_MEASURED || mask[at] == SPHC_ALIGNED_FILLED;
      EXPECT_EQ(depth[at], has ? 1500 : 0);
      EXPECT_EQ(confidence[at] > 0, has);
      with_depth += has;
    }
  }
  EXPECT_GT(with_depth, static_cast<int>(kWidth * kHeight) / 2);
  EXPECT_TRUE(memory_.guardsIntact());
  sphc_aligner_fini(&aligner_);
  EXPECT_EQ(aligner_, nullptr);
}

// The farthest that 16 bits of the unit hold is not what lies beyond it.
TEST_F(CInterfaceAligner, MetresBeyondTheLargestRangeAreHoles) {
  config_.depth_format = SPHC_FORMAT_DEPTH_F32;
  config_.rig.depth_unit_m = 1.0 / 8192;
  config_.depth_max_m = 65535 * config_.rig.depth_unit_m;
  config_.aligned_unit_m = 0.001;
  sphc_memory need = {};
  ASSERT_EQ(sphc_aligner_memory(&config_, &need, &message_), SPHC_OK) << message_.text;
  bytes_ = need.state_bytes;
  memory_ = GuardedMemory(bytes_, need.alignment);
  ASSERT_EQ(init(), SPHC_OK) << message_.text;
  for (const float metres : {7.9f, 8.1f, 1000.0f}) {
    const std::vector<float> raw(40 * 30, metres);
    std::vector<uint16_t> depth(kWidth * kHeight, 7);
    const sphc_image image = {raw.data(), 40, 30, 160, SPHC_FORMAT_DEPTH_F32};
    const sphc_aligned aligned = {sizeof aligned, 2 * kWidth, 0, 0, depth.data(), nullptr, nullptr};
    ASSERT_EQ(sphc_aligner_process(aligner_, &image, &aligned), SPHC_OK);
    EXPECT_EQ(depth[kHeight / 2 * kWidth + kWidth / 2], metres < 8 ? 7900 : 0) << metres;
  }
}

TEST_F(CInterfaceAligner, EachOutputMayBeNull) {
  ASSERT_EQ(init(), SPHC_OK);
  const sphc_image raw = image();
  std::vector<uint16_t> depth(kWidth * kHeight), again(kWidth * kHeight);
  std::vector<uint8_t> mask(kWidth * kHeight), alone(kWidth * kHeight);
  const sphc_aligned all = spherecloud::aligned(kWidth, depth.data(), mask.data());
  const sphc_aligned depth_alone = spherecloud::aligned(kWidth, again.data());
  const sphc_aligned mask_alone = spherecloud::aligned(kWidth, nullptr, alone.data());
  const sphc_aligned nothing = spherecloud::aligned(kWidth, nullptr);
  EXPECT_EQ(sphc_aligner_process(aligner_, &raw, &all), SPHC_OK);
  EXPECT_EQ(sphc_aligner_process(aligner_, &raw, &depth_alone), SPHC_OK);
  EXPECT_EQ(sphc_aligner_process(aligner_, &raw, &mask_alone), SPHC_OK);
  EXPECT_EQ(sphc_aligner_process(aligner_, &raw, &nothing), SPHC_OK);
  EXPECT_EQ(depth, again);
  EXPECT_EQ(mask, alone);
}

TEST_F(CInterfaceAligner, ForbiddenConfigs) {
  struct Spoiled {
    const char *words;
    void (*spoil)(sphc_aligner_config *);
  };
  const Spoiled all[] = {
      {"color_camera", [](sphc_aligner_config *c) { c->rig.color_camera.model = 9; }},
      {"depth_camera", [](sphc_aligner_config *c) { c->rig.depth_camera.params[0] = std::nan(""); }},
      {"color_from_depth", [](sphc_aligner_config *c) { c->rig.color_from_depth.q_wxyz[0] = 2; }},
      {"color_from_depth", [](sphc_aligner_config *c) { c->rig.color_from_depth.t_m[1] = std::nan(""); }},
      {"color_from_depth.t_m", [](sphc_aligner_config *c) { c->rig.color_from_depth.t_m[1] = 1e9; }},
      {"depth_unit_m", [](sphc_aligner_config *c) { c->rig.depth_unit_m = 0; }},
      {"depth_max_m", [](sphc_aligner_config *c) { c->depth_max_m = c->depth_min_m; }},
      {"depth_sigma_m", [](sphc_aligner_config *c) { c->depth_sigma_m = std::nan(""); }},
      {"aligned_unit_m", [](sphc_aligner_config *c) { c->aligned_unit_m = std::nan(""); }},
      {"raise the unit", [](sphc_aligner_config *c) { c->aligned_unit_m = 1e-5; }},
  };
  for (const Spoiled &spoiled : all) {
    sphc_aligner_config config = config_;
    spoiled.spoil(&config);
    Output<sphc_memory> need;
    EXPECT_EQ(sphc_aligner_memory(&config, need.get(), &message_), SPHC_E_ARGUMENT) << spoiled.words;
    expectMentions(message_.text, spoiled.words);
    EXPECT_TRUE(need.untouched());
    EXPECT_EQ(sphc_aligner_init(memory_.data(), bytes_, &config, &aligner_, &message_), SPHC_E_ARGUMENT);
    EXPECT_EQ(aligner_, nullptr);
  }
  config_.struct_size = 3;
  EXPECT_EQ(init(), SPHC_E_STRUCT_SIZE);
  expectMentions(message_.text, "sizeof(sphc_aligner_config)");
  EXPECT_EQ(sphc_aligner_config_init(nullptr, sizeof config_), SPHC_E_ARGUMENT);
  Output<sphc_aligner_config> untouched;
  EXPECT_EQ(sphc_aligner_config_init(untouched.get(), sizeof config_ - 1), SPHC_E_STRUCT_SIZE);
  EXPECT_TRUE(untouched.untouched());
}

TEST_F(CInterfaceAligner, ForbiddenMemory) {
  sphc_memory need = {};
  EXPECT_EQ(sphc_aligner_memory(nullptr, &need, &message_), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_aligner_memory(&config_, nullptr, &message_), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_aligner_init(nullptr, bytes_, &config_, &aligner_, &message_), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_aligner_init(memory_.data(), bytes_, nullptr, &aligner_, &message_), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_aligner_init(memory_.data(), bytes_, &config_, nullptr, &message_), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_aligner_init(memory_.data(), bytes_ - 1, &config_, &aligner_, &message_), SPHC_E_MEMORY_SIZE);
  EXPECT_EQ(sphc_aligner_init(static_cast<uint8_t *>(memory_.data()) + 1, bytes_, &config_, &aligner_, &message_),
            SPHC_E_MEMORY_ALIGNMENT);
  auto *inside = reinterpret_cast<sphc_aligner_config *>(static_cast<uint8_t *>(memory_.data()) + 64);
  *inside = config_;
  EXPECT_EQ(aligner_, nullptr);
  EXPECT_EQ(sphc_aligner_init(memory_.data(), bytes_, inside, &aligner_, &message_), SPHC_OK)
      << "the config is copied before the memory is used: " << message_.text;
  sphc_aligner_fini(nullptr);
}

TEST_F(CInterfaceAligner, ForbiddenImages) {
  ASSERT_EQ(init(), SPHC_OK);
  std::vector<uint16_t> depth(kWidth * kHeight, 7);
  std::vector<uint8_t> mask(kWidth * kHeight, 7);
  const sphc_aligned good = spherecloud::aligned(kWidth, depth.data(), mask.data());
  const sphc_image raw = image();
  const auto refuses = [&](const sphc_image *in, const sphc_aligned *out, sphc_status status, const char *words) {
    EXPECT_EQ(sphc_aligner_process(aligner_, in, out), status) << words;
    expectMentions(sphc_aligner_message(aligner_), words);
  };
  refuses(nullptr, &good, SPHC_E_ARGUMENT, "depth is null");
  refuses(&raw, nullptr, SPHC_E_ARGUMENT, "aligned is null");
  sphc_image image = raw;
  image.width = 41;
  refuses(&image, &good, SPHC_E_IMAGE, "41 x 30");
  image = raw;
  image.format = SPHC_FORMAT_GRAY8;
  refuses(&image, &good, SPHC_E_IMAGE, "DEPTH16");
  image = raw;
  image.stride_bytes = 79;
  refuses(&image, &good, SPHC_E_IMAGE, "stride");
  image = raw;
  image.data = nullptr;
  refuses(&image, &good, SPHC_E_IMAGE, "null");
  sphc_aligned aligned = good;
  aligned.struct_size = 8;
  refuses(&raw, &aligned, SPHC_E_STRUCT_SIZE, "sizeof(sphc_aligned)");
  aligned = good;
  aligned.depth_stride_bytes = 2 * kWidth - 2;
  refuses(&raw, &aligned, SPHC_E_IMAGE, "depth_stride_bytes");
  aligned = good;
  aligned.depth_stride_bytes = 2 * kWidth + 1;
  refuses(&raw, &aligned, SPHC_E_IMAGE, "even");
  aligned = good;
  aligned.mask_stride_bytes = kWidth - 1;
  refuses(&raw, &aligned, SPHC_E_IMAGE, "mask_stride_bytes");
  EXPECT_EQ(sphc_aligner_process(nullptr, &raw, &good), SPHC_E_ARGUMENT);
  for (uint16_t d : depth) EXPECT_EQ(d, 7);  // untouched by all that
  for (uint8_t m : mask) EXPECT_EQ(m, 7);
  EXPECT_EQ(sphc_aligner_process(aligner_, &raw, &good), SPHC_OK);  // and it goes on
}

TEST_F(CInterfaceAligner, FromCpp) {
  spherecloud::Aligner aligner;
  ASSERT_TRUE(spherecloud::Aligner::make(config_, &aligner).ok());
  std::vector<uint16_t> depth(kWidth * kHeight);
  const sphc_aligned aligned = spherecloud::aligned(kWidth, depth.data());
  const spherecloud::Aligner moved = std::move(aligner);
  EXPECT_FALSE(aligner);
  spherecloud::Aligner used;
  ASSERT_TRUE(spherecloud::Aligner::make(config_, &used).ok());
  EXPECT_TRUE(used.process(image(), aligned).ok());
  EXPECT_EQ(depth[kWidth * kHeight / 2 + kWidth / 2], 1500);
  const spherecloud::Status refused = used.process({}, aligned);
  EXPECT_TRUE(refused.failed());
  expectMentions(refused.text(), "give the pixels");
}

// For static buffers: of every size, lens and format, and not wasteful where it matters.
TEST(CInterfaceAlignerMemory, TheUpperBoundHolds) {
  sphc_aligner_config config = spherecloud::defaultAlignerConfig();
  for (const uint32_t color_width : {16u, 17u, 641u, 8192u})
    for (const uint32_t color_height : {16u, 481u, 8192u})
      for (const uint32_t depth_width : {16u, 17u, 641u, 8192u})
        for (const uint32_t depth_height : {16u, 481u, 8192u})
          for (const sphc_format format : {SPHC_FORMAT_DEPTH16, SPHC_FORMAT_DEPTH_F32, SPHC_FORMAT_RANGE16})
            for (const sphc_camera_model model : {SPHC_CAMERA_PINHOLE, SPHC_CAMERA_KANNALA_BRANDT4}) {
              config.depth_format = format;
              config.rig.color_camera = sphc::test::pinhole(color_width, color_height, 500);
              config.rig.depth_camera = sphc::test::pinhole(depth_width, depth_height, 500);
              config.rig.depth_camera.model = model;
              config.rig.depth_camera.param_count = model == SPHC_CAMERA_PINHOLE ? 4 : 8;
              sphc_memory need = {};
              ASSERT_EQ(sphc_aligner_memory(&config, &need, nullptr), SPHC_OK);
              ASSERT_LE(need.state_bytes,
                        SPHC_ALIGNER_BYTES_MAX(depth_width, depth_height, color_width, color_height));
            }
  config.rig.color_camera = config.rig.depth_camera = sphc::test::pinhole(640, 480, 500);
  config.depth_format = SPHC_FORMAT_DEPTH16;
  config.rig.depth_camera.model = SPHC_CAMERA_KANNALA_BRANDT4;
  config.rig.depth_camera.param_count = 8;
  sphc_memory need = {};
  ASSERT_EQ(sphc_aligner_memory(&config, &need, nullptr), SPHC_OK);
  EXPECT_LE(SPHC_ALIGNER_BYTES_MAX(640, 480, 640, 480), 2 * need.state_bytes);
}

}  // namespace
