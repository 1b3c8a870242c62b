// Sizes, extremes, budgets and memory.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/runtime/stages/features/features_fixture.h"

namespace sphc {
namespace {

bool isInside(const Keypoint &k, const TestImage &image) {
  return k.x_px >= 0 && k.y_px >= 0 && k.x_px <= static_cast<float>(image.width) &&
         k.y_px <= static_cast<float>(image.height) && k.scale_px > 0 && std::isfinite(k.scale_px) &&
         std::abs(k.orientation_rad) <= static_cast<float>(kPi) && k.response > 0 && std::isfinite(k.response);
}

void checkImage(const TestImage &image, int32_t first_octave = 0) {
  FeatureConfig config = configFor(image, 300);
  config.first_octave = first_octave;
  config.max_orientations = 2;
  ASSERT_TRUE(FeatureExtractor::accepts(config));
  TestExtractor extractor(config);
  const Features found = extractor(image);
  EXPECT_TRUE(extractor.sound()) << image.width << " x " << image.height;
  for (const Keypoint &k : found.keypoints) EXPECT_TRUE(isInside(k, image)) << k.x_px << ", " << k.y_px;
}

TEST(Limits, AnySizeIsSafe) {
  const int32_t sizes[][2] = {{16, 16}, {17, 16},  {16, 31},   {19, 23},  {33, 17},   {16, 500},  {500, 16},
                              {63, 65}, {97, 101}, {127, 255}, {333, 77}, {641, 479}, {1001, 35}, {20, 2000}};
  for (const auto &size : sizes) {
    checkImage(noise(size[0], size[1], 1));
    checkImage(noise(size[0], size[1], 2), -1);
    checkImage(spots(size[0], size[1], 3));
  }
}

TEST(Limits, TheLargestSideIsSafe) {
  checkImage(noise(kMaxImageSide, 24, 5));
  checkImage(noise(24, kMaxImageSide, 5));
}

TEST(Limits, FlatImagesHaveNothing) {
  for (const int32_t level : {0, 1, 77, 128, 254, 255}) {
    TestImage image(131, 97);
    std::fill(image.pixels.begin(), image.pixels.end(), static_cast<uint8_t>(level));
    for (const float threshold : {0.001f, 1e-4f}) {
      FeatureConfig config = configFor(image);
      config.contrast_threshold = threshold;
      EXPECT_EQ(TestExtractor(config)(image).keypoints.size(), 0u) << level;
    }
  }
}

TEST(Limits, ExtremesAreSafe) {
  checkImage(
      draw(128, 96, [](double x, double y) { return (static_cast<int>(x) + static_cast<int>(y)) % 2 * 255.0; }));
  checkImage(draw(128, 96, [](double x, double) { return static_cast<int>(x / 8) % 2 * 255.0; }));
  checkImage(draw(
      128, 96, [](double x, double y) { return (static_cast<int>(x / 8) + static_cast<int>(y / 8)) % 2 * 255.0; }));
  checkImage(draw(128, 96, [](double x, double y) {
    return static_cast<int>(x) == 64 && static_cast<int>(y) == 48 ? 255.0 : 0.0;
  }));
  checkImage(draw(128, 96, [](double x, double y) { return x + y; }));
}

TEST(Limits, WhatLiesBeyondTheWidthIsNotRead) {
  const TestImage tight = spots(150, 110, 4);
  TestImage wide(150, 110, 192);
  std::fill(wide.pixels.begin(), wide.pixels.end(), uint8_t{255});
  for (int32_t y = 0; y < 110; ++y) std::memcpy(&wide.at(0, y), &tight.pixels[static_cast<size_t>(150 * y)], 150);
  EXPECT_TRUE(same(extractFrom(tight), extractFrom(wide)));
}

TEST(Limits, TheBudgetIsKeptAndFilled) {
  const TestImage image = noise(640, 480, 9);
  for (const uint32_t budget : {1u, 2u, 47u, 600u}) {
    for (const int32_t orientations : {1, 2}) {
      FeatureConfig config = configFor(image, budget);
      config.max_orientations = orientations;
      TestExtractor extractor(config);
      EXPECT_EQ(extractor(image).keypoints.size(), budget);
      EXPECT_TRUE(extractor.sound());
    }
  }
}

TEST(Limits, StrongestComeFirstAndNoneTwice) {
  const Features found = extractFrom(spots(320, 240, 6), 500);
  ASSERT_GT(found.keypoints.size(), 100u);
  for (size_t i = 1; i < found.keypoints.size(); ++i) {
    const Keypoint &a = found.keypoints[i - 1], &b = found.keypoints[i];
    EXPECT_GE(a.response, b.response);
    EXPECT_FALSE(a.x_px == b.x_px && a.y_px == b.y_px && a.scale_px == b.scale_px);
  }
}

// One corner full of strong texture, faint texture elsewhere: the corner gets its quota and no more.
TEST(Limits, TheBudgetIsSpread) {
  TestImage image = noise(640, 480, 10);
  for (int32_t y = 0; y < 480; ++y) {
    for (int32_t x = 0; x < 640; ++x) {
      if (x >= 160 || y >= 160) image.at(x, y) = static_cast<uint8_t>(100 + image.at(x, y) / 8);
    }
  }
  const Features found = extractFrom(image, 480);
  ASSERT_EQ(found.keypoints.size(), 480u);
  size_t in_corner = 0;
  for (const Keypoint &k : found.keypoints) in_corner += k.x_px < 160 && k.y_px < 160;
  EXPECT_LE(in_corner, 4u * 31u + 8u);  // four cells, three times a share of ten and one each; keypoints on the rim
  EXPECT_GE(in_corner, 30u);
}

TEST(Limits, ConfigurationsOutOfRangeAreRefused) {
  FeatureConfig good;
  EXPECT_TRUE(FeatureExtractor::accepts(good));
  for (const auto &spoil :
       {std::function<void(FeatureConfig *)>([](FeatureConfig *c) { c->width = 15; }),
        std::function<void(FeatureConfig *)>([](FeatureConfig *c) { c->height = 8193; }),
        std::function<void(FeatureConfig *)>([](FeatureConfig *c) { c->max_keypoints = 0; }),
        std::function<void(FeatureConfig *)>([](FeatureConfig *c) { c->contrast_threshold = NAN; }),
        std::function<void(FeatureConfig *)>([](FeatureConfig *c) { c->edge_ratio = 0; }),
        std::function<void(FeatureConfig *)>([](FeatureConfig *c) { c->first_octave = -2; }),
        std::function<void(FeatureConfig *)>([](FeatureConfig *c) { c->max_octaves = 0; }),
        std::function<void(FeatureConfig *)>([](FeatureConfig *c) { c->max_orientations = 3; })}) {
    FeatureConfig config = good;
    spoil(&config);
    EXPECT_FALSE(FeatureExtractor::accepts(config));
  }
}

TEST(Limits, MemoryStaysWithinItsLedger) {
  FeatureConfig config;
  Arena state, scratch;
  FeatureExtractor::layout(config, state, scratch, nullptr);
  EXPECT_LE(state.used(), 4096u);
  EXPECT_LE(scratch.used(), 7u << 19);
}

TEST(Limits, DescriptorsHaveTheSameLength) {
  const Features found = extractFrom(spots(320, 240, 8), 500);
  ASSERT_GT(found.descriptors.size(), 100u);
  const Descriptor zero = {};
  // 512 but for rounding and entries beyond 255
  for (const Descriptor &d : found.descriptors) EXPECT_NEAR(distance(d, zero), 512, 6);
}

}  // namespace
}  // namespace sphc
