#include "runtime/stages/consistency/depth_values.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/support/arena_memory.h"

namespace sphc {
namespace {

struct Wall {
  double x, y, z, distance_m;  // its normal
  double depth_m(double u, double v) const { return distance_m / (x * u + y * v + z); }
};

// What a camera of so many pixels, 63 degrees wide, measures of the nearest of some walls.
DepthValues valuesOf(int32_t width, int32_t height, const std::vector<Wall> &walls, bool is_inverted = false) {
  const double focal_px = width / 1.23;
  const Camera camera({SPHC_CAMERA_PINHOLE,
                       static_cast<uint32_t>(width),
                       static_cast<uint32_t>(height),
                       4,
                       {focal_px, focal_px, width / 2.0, height / 2.0}});
  DepthSamples samples;
  const test::ArenaMemory memory(
      [&](Arena &arena, bool has_memory) { DepthSamples::layout(arena, has_memory ? &samples : nullptr); });
  samples.init(camera, {0.001, 0.25, 6, 0.004, 0.002}, false);
  std::vector<uint16_t> depth;
  for (int32_t y = 0; y < height; ++y)
    for (int32_t x = 0; x < width; ++x) {
      double z_m = 6;
      for (const Wall &wall : walls) {
        const double wall_m = wall.depth_m((x + 0.5 - width / 2.0) / focal_px, (y + 0.5 - height / 2.0) / focal_px);
        if (wall_m > 0) z_m = std::min(z_m, wall_m);  // else it is behind the camera
      }
      depth.push_back(static_cast<uint16_t>(1000 * (is_inverted ? 6.5 - z_m : z_m) + 0.5));
    }
  return samples.look({depth.data(), width, height, width});
}

// Whatever the size of the image: of 64 columns, samples are less than two pixels apart.
class DepthValuesOfSizes : public testing::TestWithParam<int32_t> {};
INSTANTIATE_TEST_SUITE_P(Widths, DepthValuesOfSizes, testing::Values(64, 100, 160, 224, 320, 540, 640));

TEST_P(DepthValuesOfSizes, AWallIsPlane) {
  const int32_t width = GetParam(), height = width * 3 / 4;
  const DepthValues values = valuesOf(width, height, {{0.6, 0.2, 0.77, 2}});
  EXPECT_GT(values.slanted, 300u);
  EXPECT_LT(values.bend, 0.05);
  EXPECT_GT(values.bend, -0.05);
}

TEST_P(DepthValuesOfSizes, ACornerOfARoomIsNotBent) {
  const int32_t width = GetParam(), height = width * 3 / 4;
  for (const double turn : {0.3, 0.5, 0.7}) {
    const DepthValues values =
        valuesOf(width, height, {{turn, 0.1, 1 - turn, 1.5}, {turn - 1, 0.1, turn, 1.5}, {0, 1, 0.25, 1.3}});
    EXPECT_GT(values.slanted, 50u);
    EXPECT_LT(values.bend, 0.5) << turn;
  }
}

TEST(DepthValuesOfWideImages, ACornerOfARoomIsNotBent) {
  for (const int32_t height : {48, 100, 200})
    EXPECT_LT(valuesOf(640, height, {{0.5, 0.1, 0.5, 1.5}, {-0.5, 0.1, 0.5, 1.5}, {0, 1, 0.25, 0.4}}).bend, 0.5);
}

TEST(DepthValuesOfFewPixels, SayNothingOfBends) {
  EXPECT_EQ(valuesOf(48, 36, {{0.6, 0.2, 0.77, 2}}).slanted, 0u);
  EXPECT_EQ(valuesOf(16, 16, {{0.6, 0.2, 0.77, 2}}).slanted, 0u);
}

TEST_P(DepthValuesOfSizes, AnInvertedWallIsBent) {
  const int32_t width = GetParam(), height = width * 3 / 4;
  EXPECT_GT(valuesOf(width, height, {{0.6, 0.2, 0.77, 2}}, true).bend, 1.2);
}

}  // namespace
}  // namespace sphc
