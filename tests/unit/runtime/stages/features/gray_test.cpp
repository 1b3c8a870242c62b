#include "runtime/stages/features/gray.h"

#include <gtest/gtest.h>

#include <vector>

#include "runtime/base/random.h"

namespace sphc {
namespace {

class GrayTest : public testing::TestWithParam<int32_t> {};

TEST_P(GrayTest, FollowsTheWeightsOnEveryWidthAndStride) {
  const int32_t width = GetParam(), height = 5, stride = 3 * width + 7, gray_stride = width + 3;
  std::vector<uint8_t> color(static_cast<size_t>(stride * height)), swapped(color.size());
  Random random(3);
  for (uint8_t &byte : color) byte = static_cast<uint8_t>(random.below(256));
  for (int32_t y = 0; y < height; ++y) {
    for (int32_t x = 0; x < width; ++x) {
      for (int32_t c = 0; c < 3; ++c) {
        swapped[static_cast<size_t>(y * stride + 3 * x + c)] =
            color[static_cast<size_t>(y * stride + 3 * x + 2 - c)];
      }
    }
  }
  std::vector<uint8_t> gray(static_cast<size_t>(gray_stride * height), 77), again = gray;
  rgbToGray(color.data(), stride, width, height, gray.data(), gray_stride);
  bgrToGray(swapped.data(), stride, width, height, again.data(), gray_stride);
  EXPECT_EQ(gray, again);
  for (int32_t y = 0; y < height; ++y) {
    for (int32_t x = 0; x < gray_stride; ++x) {
      const uint8_t *p = &color[static_cast<size_t>(y * stride + 3 * x)];
      const int32_t expected = x < width ? (77 * p[0] + 150 * p[1] + 29 * p[2] + 128) / 256 : 77;
      ASSERT_EQ(gray[static_cast<size_t>(y * gray_stride + x)], expected) << x << ", " << y;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Widths, GrayTest, testing::Values(1, 2, 15, 16, 17, 31, 64, 333));

TEST(Gray, EndsStayAndWeightsSumToOne) {
  for (int32_t level = 0; level < 256; ++level) {
    const uint8_t pixel[3] = {static_cast<uint8_t>(level), static_cast<uint8_t>(level),
                              static_cast<uint8_t>(level)};
    uint8_t gray = 0;
    rgbToGray(pixel, 3, 1, 1, &gray, 1);
    EXPECT_EQ(gray, level);
  }
}

}  // namespace
}  // namespace sphc
