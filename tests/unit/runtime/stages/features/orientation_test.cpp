#include "runtime/stages/features/orientation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/arena_memory.h"

namespace sphc {
namespace {

constexpr int32_t kImageSide = 64;

class OrientationTest : public testing::Test {
 protected:
  OrientationTest()
      : memory_([this](Arena &arena, bool real) { GaussianTable::layout(arena, real ? &gaussian_ : nullptr); }) {
    gaussian_.init();
  }
  // Of a level whose sample at (x, y) is `shade`.
  template <typename Shade>
  std::vector<float> orientations(const Shade &shade, int32_t limit) {
    std::vector<int16_t> samples(kImageSide * (kImageSide + 1));
    for (int32_t y = 0; y < kImageSide; ++y)
      for (int32_t x = 0; x < kImageSide; ++x)
        samples[static_cast<size_t>(y * kImageSide + x)] = static_cast<int16_t>(shade(x, y));
    float angles[2] = {9, 9};
    const int32_t count = findOrientations(simdFeatureKernels(), {samples.data(), kImageSide, -1}, kImageSide,
                                           kImageSide, 32, 32, 2, gaussian_, limit, angles);
    return {angles, angles + count};
  }

  GaussianTable gaussian_;
  test::ArenaMemory memory_;
};

// Every sample of a ramp falls between the same two bins, so the peak is told to half a bin.
TEST_F(OrientationTest, OfARampIsItsGradient) {
  for (const double angle : {0.0, 0.7, 1.5707963, 2.9, -0.4, -2.2}) {
    const auto found = orientations(
        [&](int x, int y) { return 200 * (std::cos(angle) * (x - 32) + std::sin(angle) * (y - 32)); }, 2);
    ASSERT_EQ(found.size(), 1u) << angle;
    EXPECT_NEAR(static_cast<double>(found[0]), angle, kPi / kOrientationBins);
  }
}

// Left of the middle the grey grows to the right; right of it, a little less, downwards.
TEST_F(OrientationTest, ASecondDirectionCountsWhereItIsNearlyAsStrong) {
  const auto corner = [](double share) {
    return [share](int x, int y) { return x < 32 ? 200 * (x - 32) : share * 200 * (y - 32); };
  };
  const auto both = orientations(corner(0.95), 2);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(orientations(corner(0.95), 1).size(), 1u);
  EXPECT_EQ(orientations(corner(0.4), 2).size(), 1u);
}

TEST_F(OrientationTest, AFlatLevelHasNone) {
  EXPECT_EQ(orientations([](int, int) { return 77; }, 2).size(), 0u);
}

}  // namespace
}  // namespace sphc
