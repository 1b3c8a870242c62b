#include "drivers/simulated/paint.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

namespace sphc::simulated {
namespace {

// A square of a floor or a wall, `side` texels wide.
std::vector<Texel> square(Material material, uint32_t side, float texel_m) {
  std::vector<Texel> texels(size_t{side} * side);
  const float size_m = static_cast<float>(side) * texel_m;
  Canvas canvas(texels.data(), side, side, size_m, size_m);
  paint(canvas, material, 3, 5);
  return texels;
}

// Mean difference of the greens of texels that are so far from each other.
double differenceAt(const std::vector<Texel> &texels, uint32_t side, uint32_t shift) {
  double sum = 0;
  for (uint32_t y = 0; y < side; ++y) {
    for (uint32_t x = 0; x + shift < side; ++x) {
      const auto green = [&](uint32_t column) { return static_cast<int>((texels[y * side + column] >> 8) & 255); };
      sum += std::abs(green(x) - green(x + shift));
    }
  }
  return sum / (side * (side - shift));
}

TEST(SimulatedPaint, FloorsAndWallpaperRepeat) {
  constexpr float kTexel = 0.0025f;
  constexpr uint32_t kSide = 480;
  const struct {
    Material material;
    uint32_t period;  // texels
  } surfaces[] = {{Material::kFittedCarpet, 36},
                  {Material::kParquet, 240},
                  {Material::kTiles, 100},
                  {Material::kRepeatingWallpaper, 212}};
  for (const auto &surface : surfaces) {
    const std::vector<Texel> texels = square(surface.material, kSide, kTexel);
    const double repeated = differenceAt(texels, kSide, surface.period);
    EXPECT_LT(repeated, 6) << "wear alone";
    EXPECT_GT(differenceAt(texels, kSide, surface.period / 3), 2 * repeated);
  }
  const std::vector<Texel> planks = square(Material::kFloor, kSide, kTexel);
  for (uint32_t shift = 20; shift < kSide / 2; shift += 20) EXPECT_GT(differenceAt(planks, kSide, shift), 6);
}

TEST(SimulatedPaint, ABareWallHasNoDetail) {
  const std::vector<Texel> wall = square(Material::kBare, 240, 0.0037f);
  EXPECT_LT(differenceAt(wall, 240, 4), 1);
}

}  // namespace
}  // namespace sphc::simulated
