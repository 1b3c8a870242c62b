#include "runtime/stages/align/depth_patch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/random_numbers.h"

namespace sphc {
namespace {

const DepthSensor kPatchSensor = {0.001, 0.2, 6, 0.004, 0.002};
constexpr int kWidth = 20, kHeight = 16;

struct Image {
  std::vector<uint16_t> mm = std::vector<uint16_t>(kWidth * kHeight);
  uint16_t &at(int x, int y) { return mm[static_cast<size_t>(y * kWidth + x)]; }
  template <typename F>
  explicit Image(F depth_m) {
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) at(x, y) = static_cast<uint16_t>(std::lround(1000 * depth_m(x, y)));
  }
  PatchDepth patch(double x, double y) const {
    return patchDepth({mm.data(), kWidth, kHeight, kWidth}, kPatchSensor, x, y);
  }
};

TEST(DepthPatch, Frontal) {
  const Image image([](int, int) { return 2.0; });
  const PatchDepth patch = image.patch(8.3, 7.6);
  EXPECT_NEAR(patch.depth_m, 2, 1e-9);
  EXPECT_NEAR(patch.sigma_m, kPatchSensor.sigmaAt(2), 1e-9);
}

TEST(DepthPatch, SlantedPlaneIsFollowed) {  // a plane: inverse depth linear in the pixel
  const auto depth = [](double x, double y) { return 1 / (0.5 + 0.004 * x - 0.003 * y); };
  const Image image(depth);
  for (double x = 3; x < 16; x += 0.7)
    for (double y = 3; y < 12; y += 0.9)
      EXPECT_NEAR(image.patch(x, y).depth_m, depth(x, y), 0.004) << x << " " << y;
}

TEST(DepthPatch, AveragesNoise) {
  Random random(1);
  double squares = 0;
  for (int i = 0; i < 200; ++i) {
    const Image image([&](int, int) { return 2 + 0.012 * test::normal(&random); });
    const double error = image.patch(9, 8).depth_m - 2;
    squares += error * error;
  }
  EXPECT_LT(std::sqrt(squares / 200), 0.5 * 0.012);
}

TEST(DepthPatch, AHoleAllAroundIsRefused) {
  Image image([](int, int) { return 2.0; });
  for (int y = 4; y < 13; ++y)
    for (int x = 4; x < 13; ++x) image.at(x, y) = 0;
  EXPECT_EQ(image.patch(8, 8).depth_m, 0);
}

TEST(DepthPatch, FewPixelsAreRefused) {
  Image image([](int, int) { return 0.0; });
  for (int x = 7; x < 11; ++x) image.at(x, 8) = 2000;
  EXPECT_EQ(image.patch(8, 8).depth_m, 0);  // four
}

TEST(DepthPatch, OutOfRangeMeasurementsDoNotCount) {
  const Image far([](int, int) { return 7.0; }), near([](int, int) { return 0.1; });
  EXPECT_EQ(far.patch(8, 8).depth_m, 0);
  EXPECT_EQ(near.patch(8, 8).depth_m, 0);
}

TEST(DepthPatch, AtAnEdgeItKeepsToItsSideAndSaysSo) {
  const Image image([](int x, int) { return x < 9 ? 1.5 : 3.0; });
  const PatchDepth left = image.patch(8, 8), right = image.patch(9, 8), inside = image.patch(3, 8);
  EXPECT_NEAR(left.depth_m, 1.5, 1e-3);
  EXPECT_NEAR(right.depth_m, 3, 1e-3);
  EXPECT_GT(left.sigma_m, 1.2 * inside.sigma_m);
}

TEST(DepthPatch, OutsideTheImage) {
  const Image image([](int, int) { return 2.0; });
  for (double x : {-50.0, -3.5, 22.6, 1e6}) EXPECT_EQ(image.patch(x, 8).depth_m, 0) << x;
  EXPECT_NEAR(image.patch(0, 0).depth_m, 2, 1e-9);  // the corner has nine neighbours
}

// A hole beside an edge takes what lies nearest, not what lies behind.
TEST(DepthPatch, InAHoleTheNearestMeasurementCounts) {
  const Image image([](int x, int) { return x < 8 ? 1.5 : x < 10 ? 0.0 : 3.0; });
  EXPECT_NEAR(image.patch(7.6, 8).depth_m, 1.5, 1e-3);
  EXPECT_NEAR(image.patch(9.4, 8).depth_m, 3, 1e-3);
}

TEST(DepthPatch, NoiseBeyondTheSensorsIsTold) {
  Random random(2);
  double sum = 0;
  for (int i = 0; i < 50; ++i)
    sum += Image([&](int, int) { return 2 + 0.04 * test::normal(&random); }).patch(9, 8).sigma_m / 50;
  EXPECT_GT(sum, 2 * kPatchSensor.sigmaAt(2));
}

}  // namespace
}  // namespace sphc
