#include "drivers/simulated/smooth_depth.h"

#include <gtest/gtest.h>

namespace sphc::simulated {
namespace {

constexpr uint32_t kWidth = 16, kHeight = 9;

uint16_t at(const std::vector<uint16_t> &depth, uint32_t x, uint32_t y) { return depth[y * kWidth + x]; }

TEST(SmoothDepth, KeepsAPlaneToItsBorder) {
  std::vector<uint16_t> depth(kWidth * kHeight, 1234);
  smoothDepth(kWidth, kHeight, depth.data());
  EXPECT_EQ(depth, std::vector<uint16_t>(kWidth * kHeight, 1234));
}

TEST(SmoothDepth, MakesARampOfAnEdge) {
  std::vector<uint16_t> depth(kWidth * kHeight);
  for (uint32_t i = 0; i < depth.size(); ++i) depth[i] = i % kWidth < 8 ? 1000 : 2000;
  smoothDepth(kWidth, kHeight, depth.data());
  const uint16_t expected[] = {1000, 1200, 1400, 1600, 1800, 2000};
  for (uint32_t i = 0; i < 6; ++i) EXPECT_EQ(at(depth, 5 + i, 4), expected[i]);
}

TEST(SmoothDepth, FillsSmallHolesAndLeavesLargeOnes) {
  std::vector<uint16_t> depth(kWidth * kHeight, 1000);
  for (uint32_t y = 0; y < kHeight; ++y)
    for (uint32_t x = 6; x < 12; ++x) depth[y * kWidth + x] = 0;
  depth[2 * kWidth + 2] = 0;
  smoothDepth(kWidth, kHeight, depth.data());
  EXPECT_EQ(at(depth, 2, 2), 1000);
  EXPECT_EQ(at(depth, 7, 4), 1000) << "within reach of what was measured";
  EXPECT_EQ(at(depth, 8, 4), 0);
}

}  // namespace
}  // namespace sphc::simulated
