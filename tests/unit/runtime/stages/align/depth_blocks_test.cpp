#include "runtime/stages/align/depth_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "runtime/base/random.h"
#include "tests/support/arena_memory.h"

namespace sphc {
namespace {

constexpr int32_t kBlocksWidth = 75, kBlocksHeight = 53;  // no whole number of blocks
constexpr DepthSensor kBlockSensor = {0.001, 0.5, 4, 0.002, 0};

class DepthBlocksTest : public testing::Test {
 protected:
  DepthBlocksTest()
      : memory_([this](Arena &arena, bool real) {
          DepthBlocks::layout(kBlocksWidth, kBlocksHeight, arena, real ? &blocks_ : nullptr);
        }),
        depth_mm_(kBlocksWidth * kBlocksHeight) {}
  uint16_t &at(int32_t u, int32_t v) { return depth_mm_[static_cast<size_t>(v * kBlocksWidth + u)]; }
  void build() { blocks_.build({depth_mm_.data(), kBlocksWidth, kBlocksHeight, kBlocksWidth}, kBlockSensor); }

  DepthBlocks blocks_;
  test::ArenaMemory memory_;
  std::vector<uint16_t> depth_mm_;
};

TEST_F(DepthBlocksTest, NothingWithinReachIsNearer) {
  Random random(3);
  for (uint16_t &depth : depth_mm_)
    depth = random.below(400) ? uint16_t{0} : static_cast<uint16_t>(600 + random.below(3000));
  build();
  uint16_t nearest_of_all = DepthBlocks::kNone;
  for (int32_t v = 0; v < kBlocksHeight; ++v) {
    for (int32_t u = 0; u < kBlocksWidth; ++u) {
      const uint16_t nearest = blocks_.nearest(u, v);
      if (at(u, v)) nearest_of_all = std::min(nearest_of_all, at(u, v));
      for (int32_t y = std::max(0, v - DepthBlocks::kReachPx); y <= v + DepthBlocks::kReachPx && y < kBlocksHeight;
           ++y)
        for (int32_t x = std::max(0, u - DepthBlocks::kReachPx); x <= u + DepthBlocks::kReachPx && x < kBlocksWidth;
             ++x)
          ASSERT_LE(nearest, at(x, y) ? at(x, y) : DepthBlocks::kNone) << u << " " << v;
    }
  }
  EXPECT_EQ(blocks_.nearest(), nearest_of_all);
}

TEST_F(DepthBlocksTest, FarFromEveryMeasurementThereIsNone) {
  at(70, 50) = 900;
  build();
  EXPECT_EQ(blocks_.nearest(70, 50), 900);
  EXPECT_EQ(blocks_.nearest(60, 45), 900);
  EXPECT_EQ(blocks_.nearest(5, 5), DepthBlocks::kNone);
  EXPECT_EQ(blocks_.nearest(), 900);
}

TEST_F(DepthBlocksTest, WhatTheSensorCannotMeasureDoesNotCount) {
  at(10, 10) = 400;   // nearer than it measures
  at(11, 10) = 4100;  // farther
  at(12, 10) = 0;
  build();
  EXPECT_EQ(blocks_.nearest(10, 10), DepthBlocks::kNone);
  at(13, 10) = 501;
  at(14, 10) = 3999;
  build();
  EXPECT_EQ(blocks_.nearest(10, 10), 501);
}

TEST_F(DepthBlocksTest, EachImageStandsAlone) {
  at(10, 10) = 900;
  build();
  at(10, 10) = 0;
  build();
  EXPECT_EQ(blocks_.nearest(), DepthBlocks::kNone);
  EXPECT_EQ(blocks_.nearest(10, 10), DepthBlocks::kNone);
}

}  // namespace
}  // namespace sphc
