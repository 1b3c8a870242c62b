#include "runtime/stages/features/extrema.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/arena_memory.h"
#include "tests/unit/runtime/stages/features/features_fixture.h"

namespace sphc {
namespace {

// All extrema of an image's first octave.
std::vector<Candidate> extremaOf(const TestImage &image, const FeatureConfig &config) {
  ScaleSpace space;
  Sweep sweep;
  ExtremaFinder finder;
  CandidateList found;
  const test::ArenaMemory memory([&](Arena &arena, bool real) {
    ScaleSpace::layout(config, arena, real ? &space : nullptr);
    Sweep::layout(config, false, arena, real ? &sweep : nullptr);
    ExtremaFinder::layout(config, arena, real ? &finder : nullptr);
    CandidateList::layout(config, arena, real ? &found : nullptr);
  });
  const FeatureKernels &kernels = simdFeatureKernels();
  space.init();
  found.clear();
  space.beginOctave(0, image.view());
  sweep.begin(space, {0, space.height(0)}, kernels);
  for (int32_t y = sweep.firstStep(); y < sweep.endStep(); y += kRowsAtOnce) {
    sweep.step(y);
    for (int32_t i = 0; i < kRowsAtOnce; ++i) finder.step(kernels, sweep, y + i, &found);
  }
  const Span<Candidate> chosen = found.choose(config, config.max_keypoints);
  return {chosen.begin(), chosen.end()};
}

// Soft, `tall` times as high as wide.
TestImage spotAt(double x, double y, double sigma, double height = 150, double tall = 1) {
  return draw(96, 96, [=](double px, double py) {
    const double dx = (px - x) / sigma, dy = (py - y) / (tall * sigma);
    return 50 + height * std::exp(-0.5 * (dx * dx + dy * dy));
  });
}

TEST(Extrema, ASpotIsFoundBetweenItsPixelsAtItsScale) {
  const TestImage image = spotAt(48.8, 40.3, 2);
  const auto found = extremaOf(image, configFor(image));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(static_cast<double>(found[0].x) + 0.5, 48.8, 0.05);
  EXPECT_NEAR(static_cast<double>(found[0].y) + 0.5, 40.3, 0.05);
  const double sigma = static_cast<double>(found[0].strength / found[0].response);
  EXPECT_NEAR(sigma, 2, 0.4);
  EXPECT_NEAR(static_cast<double>(sigmaOfLayer(found[0].layer)), sigma, 1e-5);
}

TEST(Extrema, ADarkSpotCountsAsABrightOne) {
  const TestImage image = draw(96, 96, [](double x, double y) {
    return 200 - 150 * std::exp(-0.125 * ((x - 48.5) * (x - 48.5) + (y - 40.5) * (y - 40.5)));
  });
  const auto found = extremaOf(image, configFor(image));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(static_cast<double>(found[0].x) + 0.5, 48.5, 0.05);
}

TEST(Extrema, FaintSpotsAreLeftOut) {
  const TestImage image = spotAt(48.5, 40.5, 2, 40);
  FeatureConfig config = configFor(image);
  const float response = extremaOf(image, config).at(0).response;
  config.contrast_threshold = 0.9f * response;
  EXPECT_EQ(extremaOf(image, config).size(), 1u);
  config.contrast_threshold = 1.1f * response;
  EXPECT_EQ(extremaOf(image, config).size(), 0u);
}

TEST(Extrema, StraightEdgesAreLeftOut) {
  const TestImage image = spotAt(48.5, 48.5, 2, 150, 2);
  FeatureConfig config = configFor(image);
  config.edge_ratio = 30;
  EXPECT_GT(extremaOf(image, config).size(), 0u);
  config.edge_ratio = 1.5f;
  EXPECT_EQ(extremaOf(image, config).size(), 0u);
}

TEST(Extrema, AtTheBorderThereIsNone) {
  const TestImage image = spotAt(4.5, 40.5, 2);
  EXPECT_EQ(extremaOf(image, configFor(image)).size(), 0u);
}

}  // namespace
}  // namespace sphc
