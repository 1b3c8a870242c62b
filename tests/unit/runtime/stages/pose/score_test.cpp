#include "runtime/stages/pose/score.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "runtime/stages/pose/residual.h"
#include "tests/support/pose_world.h"
#include "tests/support/random_numbers.h"

namespace sphc {
namespace {

constexpr float kTruncation = 12, kNoBound = std::numeric_limits<float>::max();

struct Scorer {
  explicit Scorer(uint32_t capacity) {
    Arena measure;
    PoseScorer::layout(capacity, measure, nullptr);
    memory.resize(measure.used() + kArenaAlignment);
    uint8_t *start = memory.data();
    while (reinterpret_cast<uintptr_t>(start) % kArenaAlignment) ++start;
    Arena arena(start);
    PoseScorer::layout(capacity, arena, &scorer);
  }
  std::vector<uint8_t> memory;
  PoseScorer scorer;
};

double slowScore(const test::PoseWorld &world, const Rigid &pose) {
  double sum = 0;
  for (const Correspondence &c : world.correspondences) {
    const Residual r = residualOf(c, pose);
    sum += r.in_front && r.squared < 12 ? r.squared : 12;
  }
  return sum;
}

TEST(Score, IsTheTruncatedSumOfTheResiduals) {
  Random random(1);
  for (size_t count : {4u, 31u, 32u, 33u, 300u}) {
    test::PoseWorldOptions options;
    options.count = count;
    options.true_share = 0.5;
    options.depth_sigma_m = 0.01;
    options.pixel_sigma_px = 0.8;
    const test::PoseWorld world = test::makePoseWorld(options);
    Scorer s(300);
    s.scorer.load({world.correspondences.data(), count});
    for (int i = 0; i < 20; ++i) {
      const Rigid pose =
          i == 0 ? world.camera_from_map : Rigid{test::randomRotation(&random), test::normalVector(&random)};
      const double expected = slowScore(world, pose);
      EXPECT_NEAR(static_cast<double>(s.scorer.score(pose, kTruncation, kNoBound)), expected,
                  1e-3 * expected + 1e-2);
    }
  }
}

TEST(Score, GivesUpAtTheBound) {
  const test::PoseWorld world = test::makePoseWorld({});
  Scorer s(300);
  s.scorer.load({world.correspondences.data(), world.correspondences.size()});
  const float score = s.scorer.score(Rigid(), kTruncation, 50.0f);
  EXPECT_GE(score, 50.0f);
  EXPECT_LE(score, 50.0f + 33 * kTruncation);
}

TEST(Score, TheTruthScoresBest) {
  Random random(2);
  test::PoseWorldOptions options;
  options.true_share = 0.33;
  const test::PoseWorld world = test::makePoseWorld(options);
  Scorer s(300);
  s.scorer.load({world.correspondences.data(), world.correspondences.size()});
  const float truth = s.scorer.score(world.camera_from_map, kTruncation, kNoBound);
  for (int i = 0; i < 2000; ++i) {
    const Rigid other = {test::randomRotation(&random), 2 * test::normalVector(&random)};
    EXPECT_LT(truth, s.scorer.score(other, kTruncation, kNoBound));
  }
}

}  // namespace
}  // namespace sphc
