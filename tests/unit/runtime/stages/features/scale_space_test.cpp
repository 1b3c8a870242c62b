#include "runtime/stages/features/sweep.h"

#include <gtest/gtest.h>

#include <cmath>

#include "runtime/base/parallel.h"
#include "tests/support/arena_memory.h"
#include "tests/unit/runtime/stages/features/features_fixture.h"

namespace sphc {
namespace {

class TestSpace {
 public:
  explicit TestSpace(const FeatureConfig &config)
      : memory_([&](Arena &arena, bool real) {
          ScaleSpace::layout(config, arena, real ? &space : nullptr);
          for (Sweep &sweep : sweeps_) Sweep::layout(config, true, arena, real ? &sweep : nullptr);
        }) {
    space.init();
  }
  void sweepOctave(int32_t octave, const TestImage &image, uint32_t pieces = 1) {
    space.beginOctave(octave, image.view());
    for (uint32_t i = 0; i < pieces; ++i) {
      const Part part = partOf(static_cast<size_t>(space.height(octave)), pieces, i);
      sweeps_[i].begin(space, {static_cast<int32_t>(part.first), static_cast<int32_t>(part.size())},
                       simdFeatureKernels());
      for (int32_t y = sweeps_[i].firstStep(); y < sweeps_[i].endStep(); y += kRowsAtOnce) sweeps_[i].step(y);
    }
  }
  void sweep(const TestImage &image, uint32_t pieces = 1) {
    for (int32_t octave = 0; octave < space.octaves(); ++octave) sweepOctave(octave, image, pieces);
  }
  void skimOctave(int32_t octave, const TestImage &image) {
    space.beginOctave(octave, image.view());
    sweeps_[0].begin(space, {0, space.height(octave)}, simdFeatureKernels());
    for (int32_t y = 0; y < sweeps_[0].skimCount(); y += kRowsAtOnce) sweeps_[0].skim(y);
  }
  // Grey level, 0 to 255.
  double at(int32_t octave, int32_t level, int32_t x, int32_t y) const {
    return space.kept(octave, level).row(y)[x] / double{kSampleScale} + kGrayMiddle;
  }

  ScaleSpace space;

 private:
  Sweep sweeps_[Parallel::kMostPieces];
  test::ArenaMemory memory_;
};

TEST(ScaleSpace, SigmasDoubleInThreeLayers) {
  for (float layer = 0; layer < 6; layer += 0.1f)
    EXPECT_NEAR(static_cast<double>(sigmaOfLayer(layer)), std::pow(2, static_cast<double>(layer) / 3), 1e-5);
}

TEST(ScaleSpace, OctavesHalveTheImageUntilItIsSmall) {
  FeatureConfig config;
  config.width = 200;
  config.height = 101;
  const TestSpace made(config);
  const ScaleSpace &space = made.space;
  ASSERT_EQ(space.octaves(), 4);  // 101, 51, 26, 13; 7 would be too small
  for (int32_t octave = 0; octave < 4; ++octave)
    EXPECT_EQ(space.pixelSize(octave), static_cast<float>(1 << octave));
  EXPECT_EQ(space.width(1), 100);
  EXPECT_EQ(space.height(1), 51);
  EXPECT_EQ(space.height(3), 13);
  config.max_octaves = 2;
  EXPECT_EQ(TestSpace(config).space.octaves(), 2);
  config.first_octave = -1;
  const TestSpace doubled(config);
  EXPECT_EQ(doubled.space.width(0), 400);
  EXPECT_EQ(doubled.space.pixelSize(0), 0.5f);
}

TEST(ScaleSpace, AFlatImageStaysFlat) {
  const TestImage image = draw(64, 48, [](double, double) { return 90; });
  TestSpace space(configFor(image));
  space.sweep(image);
  for (int32_t octave = 0; octave < space.space.octaves(); ++octave)
    for (int32_t level = 1; level <= kScales; ++level)
      EXPECT_NEAR(space.at(octave, level, space.space.width(octave) / 2, 3), 90, 0.2);
}

// An octave is made from one that was only skimmed as from one that was swept.
TEST(ScaleSpace, SkimmingMakesWhatTheNextOctaveNeeds) {
  const TestImage image = spots(161, 119, 5);
  for (const int32_t first_octave : {0, -1}) {
    FeatureConfig config = configFor(image);
    config.first_octave = first_octave;
    TestSpace swept(config), skimmed(config);
    swept.sweep(image);
    const ScaleSpace &space = skimmed.space;
    const int32_t last = 2;
    for (int32_t octave = 0; octave < last; ++octave) skimmed.skimOctave(octave, image);
    skimmed.sweepOctave(last, image);
    for (int32_t level = 1; level <= kScales; ++level)
      for (int32_t y = 0; y < space.height(last); ++y)
        for (int32_t x = 0; x < space.width(last); ++x)
          ASSERT_NEAR(skimmed.at(last, level, x, y), swept.at(last, level, x, y), 2.5) << x << ", " << y;
  }
}

// Pieces write each row of a kept level once: what the others do for themselves is nobody's.
TEST(ScaleSpace, PiecesMakeTheSameLevels) {
  const TestImage image = spots(161, 119, 5);
  for (const int32_t first_octave : {0, -1})
    for (const uint32_t pieces : {2u, 3u, 8u}) {
      FeatureConfig config = configFor(image);
      config.first_octave = first_octave;
      TestSpace whole(config), cut(config);
      whole.sweep(image);
      cut.sweep(image, pieces);
      for (int32_t octave = 0; octave < whole.space.octaves(); ++octave)
        for (int32_t level = 1; level <= kScales; ++level)
          for (int32_t y = 0; y < whole.space.height(octave); ++y)
            for (int32_t x = 0; x < whole.space.width(octave); ++x)
              ASSERT_EQ(cut.at(octave, level, x, y), whole.at(octave, level, x, y)) << x << ", " << y;
    }
}

// A soft spot of sigma s, blurred by b, is one of sqrt(s^2 + b^2), and lower by the ratio of their areas.
TEST(ScaleSpace, LevelsAreBlurredAsTheySay) {
  constexpr double kSpot = 4;
  const TestImage image = draw(128, 128, [](double x, double y) {
    return 40 + 200 * std::exp(-((x - 64.5) * (x - 64.5) + (y - 64.5) * (y - 64.5)) / (2 * kSpot * kSpot));
  });
  TestSpace space(configFor(image));
  space.sweep(image);
  for (int32_t octave = 0; octave < 2; ++octave) {
    for (int32_t level = 1; level <= kScales; ++level) {
      const double blur = static_cast<double>(sigmaOfLayer(static_cast<float>(level))) * (1 << octave);
      const double peak = 40 + 200 * kSpot * kSpot / (kSpot * kSpot + blur * blur);
      EXPECT_NEAR(space.at(octave, level, 64 >> octave, 64 >> octave), peak, 4) << octave << " " << level;
    }
  }
}

}  // namespace
}  // namespace sphc
