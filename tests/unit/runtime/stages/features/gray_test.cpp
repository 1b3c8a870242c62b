#include "runtime/stages/features/gray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "runtime/base/random.h"

namespace sphc {
namespace {

using Bytes = std::vector<uint8_t>;

Bytes randomBytes(int32_t count, uint64_t seed) {
  Bytes bytes(static_cast<size_t>(count));
  Random random(seed);
  for (uint8_t &byte : bytes) byte = static_cast<uint8_t>(random.below(256));
  return bytes;
}

LumaLayout layoutOf(LumaLayout::Kind kind, int32_t group_pixels, int32_t group_bytes) {
  LumaLayout layout;
  layout.kind = kind;
  layout.group_pixels = static_cast<uint8_t>(group_pixels);
  layout.group_bytes = static_cast<uint8_t>(group_bytes);
  return layout;
}

// The grey of bytes whose rows are `stride` apart.
Bytes grayBytes(const Bytes &bytes, int32_t width, int32_t height, int32_t stride, const LumaLayout &layout) {
  Bytes gray(static_cast<size_t>(width * height));
  const GrayView view = grayOf({{bytes.data(), width, height, stride}, layout}, {gray.data(), gray.size()});
  EXPECT_EQ(view.data, gray.data());
  EXPECT_EQ(view.width, width);
  EXPECT_EQ(view.height, height);
  EXPECT_EQ(view.stride, width);
  return gray;
}

class GrayTest : public testing::TestWithParam<int32_t> {};

TEST_P(GrayTest, FollowsTheWeightsOnEveryWidthAndStride) {
  for (const int32_t channels : {3, 4}) {
    const int32_t width = GetParam(), height = 5, stride = channels * width + 7;
    const Bytes color = randomBytes(stride * height, 3);
    Bytes swapped = color;
    for (int32_t y = 0; y < height; ++y)
      for (int32_t x = 0; x < width; ++x)
        std::swap(swapped[static_cast<size_t>(y * stride + channels * x)],
                  swapped[static_cast<size_t>(y * stride + channels * x + 2)]);
    const Bytes gray = grayBytes(color, width, height, stride, layoutOf(LumaLayout::kRgb, 1, channels));
    EXPECT_EQ(gray, grayBytes(swapped, width, height, stride, layoutOf(LumaLayout::kBgr, 1, channels)));
    for (int32_t y = 0; y < height; ++y) {
      for (int32_t x = 0; x < width; ++x) {
        const uint8_t *p = &color[static_cast<size_t>(y * stride + channels * x)];
        ASSERT_EQ(gray[static_cast<size_t>(y * width + x)], (77 * p[0] + 150 * p[1] + 29 * p[2] + 128) / 256)
            << x << ", " << y;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Widths, GrayTest, testing::Values(1, 2, 15, 16, 17, 31, 64, 333));

TEST(Gray, EndsStayAndWeightsSumToOne) {
  for (int32_t level = 0; level < 256; ++level) {
    const Bytes pixel(4, static_cast<uint8_t>(level));
    EXPECT_EQ(grayBytes(pixel, 1, 1, 4, layoutOf(LumaLayout::kRgb, 1, 4))[0], level);
  }
}

TEST(Gray, AByteAPixelIsReadInPlace) {
  const Bytes pixels(12, 7);
  Bytes unused;
  const GrayView view = grayOf({{pixels.data(), 3, 2, 6}, LumaLayout()}, {unused.data(), 0});
  EXPECT_EQ(view.data, pixels.data());
  EXPECT_EQ(view.stride, 6);
}

TEST(Gray, LumaAmongChroma) {
  LumaLayout layout = layoutOf(LumaLayout::kBytes, 1, 2);
  const Bytes two_rows = {1, 99, 2, 98, 3, 97, 0, 0, 4, 96, 5, 95, 6, 94, 0, 0};
  EXPECT_EQ(grayBytes(two_rows, 3, 2, 8, layout), (Bytes{1, 2, 3, 4, 5, 6}));
  layout.first = 1;
  EXPECT_EQ(grayBytes(two_rows, 3, 2, 8, layout), (Bytes{99, 98, 97, 96, 95, 94}));
}

TEST(Gray, HighBitsOfPackedPixels) {
  const Bytes ten = {10, 20, 30, 40, 0xFF, 50, 60, 70, 80, 0xFF};
  EXPECT_EQ(grayBytes(ten, 8, 1, 10, layoutOf(LumaLayout::kBytes, 4, 5)), (Bytes{10, 20, 30, 40, 50, 60, 70, 80}));
  const Bytes twelve = {10, 20, 0xFF, 30, 40, 0xFF};
  EXPECT_EQ(grayBytes(twelve, 4, 1, 6, layoutOf(LumaLayout::kBytes, 2, 3)), (Bytes{10, 20, 30, 40}));
}

// Bits above those that count belong to no pixel; they saturate and do not wrap around.
TEST(Gray, HighBitsOfWords) {
  const Bytes words = {0xFF, 0x03, 0x00, 0x02, 0x03, 0x00, 0xFF, 0xFF};
  LumaLayout layout = layoutOf(LumaLayout::kWords, 1, 2);
  layout.bits = 10;
  EXPECT_EQ(grayBytes(words, 4, 1, 8, layout), (Bytes{255, 128, 0, 255}));
  layout.bits = 12;
  EXPECT_EQ(grayBytes(words, 4, 1, 8, layout), (Bytes{63, 32, 0, 255}));
  layout.bits = 16;
  EXPECT_EQ(grayBytes(words, 4, 1, 8, layout), (Bytes{3, 2, 0, 255}));
}

TEST(Gray, GreensOfAFilter) {
  // Greens are 10 times their column and row; all else is 200.
  const int32_t width = 4, height = 3;
  for (const int32_t parity : {0, 1}) {
    Bytes raw;
    for (int32_t y = 0; y < height; ++y)
      for (int32_t x = 0; x < width; ++x)
        raw.push_back((x + y) % 2 == parity ? static_cast<uint8_t>(10 * x + 10 * y) : uint8_t{200});
    LumaLayout layout;
    layout.green = parity ? LumaLayout::kGreenOdd : LumaLayout::kGreenEven;
    const Bytes gray = grayBytes(raw, width, height, width, layout);
    for (int32_t y = 0; y < height; ++y) {
      for (int32_t x = 0; x < width; ++x) {
        const bool inside = x > 0 && x + 1 < width && y > 0 && y + 1 < height;
        const int32_t value = gray[static_cast<size_t>(y * width + x)];
        if (inside || (x + y) % 2 == parity) {
          EXPECT_EQ(value, 10 * x + 10 * y) << x << ", " << y;
        } else {
          EXPECT_NEAR(value, 10 * x + 10 * y, 10) << x << ", " << y;
        }
      }
    }
  }
}

}  // namespace
}  // namespace sphc
