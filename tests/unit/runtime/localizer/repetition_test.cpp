#include "runtime/localizer/repetition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/backwards.h"
#include "tests/unit/runtime/localizer/room_parts.h"

namespace sphc {
namespace {

class RepetitionTest : public testing::Test {
 protected:
  test::RoomParts parts_;
};

TEST_F(RepetitionTest, ARoomHasNoPattern) {
  for (uint32_t viewpoint = 0; viewpoint < 3; ++viewpoint) {
    parts_.see(viewpoint);
    EXPECT_TRUE(parts_.repetition.look(parts_.front, {}));
    EXPECT_TRUE(parts_.repetition.moves_m().empty()) << viewpoint;
  }
}

TEST_F(RepetitionTest, FindsThePeriodOfAPattern) {
  for (uint32_t period_px : {48u, 64u}) {
    parts_.seeRepeated(0, period_px);
    ASSERT_TRUE(parts_.repetition.look(parts_.front, {}));
    ASSERT_FALSE(parts_.repetition.moves_m().empty()) << period_px;
    const double period_m = 2 * period_px / parts_.config.color_camera.focal();
    const Vector3 &move_m = parts_.repetition.moves_m()[0];
    const double times = std::round(move_m.norm() / period_m);
    EXPECT_GE(times, 1) << period_px;
    EXPECT_NEAR(std::abs(move_m.x()), times * period_m, 0.01) << period_px;
    EXPECT_NEAR(move_m.tail<2>().norm(), 0, 0.01) << period_px;
  }
}

// Each of the moves goes this far aside from the line of each before it, at least.
void expectDirectionsOfTheirOwn(Span<const Vector3> moves_m, uint32_t period_px) {
  for (size_t i = 1; i < moves_m.size(); ++i)
    for (size_t k = 0; k < i; ++k)
      EXPECT_GT(moves_m[k].cross(moves_m[i]).norm() / moves_m[k].norm(), tuning::kSameMoveM) << period_px;
}

// Of a pattern that is finer than the least move, twice and three times its period are common.
TEST_F(RepetitionTest, MovesAlongOneLineAreOne) {
  for (const uint32_t period_px : {12u, 16u, 20u, 24u}) {
    parts_.seeRepeated(0, period_px);
    ASSERT_TRUE(parts_.repetition.look(parts_.front, {}));
    ASSERT_FALSE(parts_.repetition.moves_m().empty()) << period_px;
    expectDirectionsOfTheirOwn(parts_.repetition.moves_m(), period_px);
  }
}

TEST_F(RepetitionTest, TilesHaveMovesOfSeveralDirections) {
  constexpr uint32_t kPeriodPx = 40;
  const auto made = test::sceneFrame(test::sceneConfig(), 0);
  const std::vector<uint8_t> seen = made->images.gray;
  const uint32_t width = made->frame.color.width;
  Random random(1);
  for (uint32_t i = 0; i < seen.size(); ++i) {
    const uint32_t x = kPeriodPx + i % width % kPeriodPx, y = kPeriodPx + i / width % kPeriodPx;
    made->images.gray[i] = static_cast<uint8_t>(std::min(255u, seen[y * width + x] + random.below(12)));
  }
  std::fill(made->images.depth_mm.begin(), made->images.depth_mm.end(), uint16_t{2000});
  parts_.see(*made);
  ASSERT_TRUE(parts_.repetition.look(parts_.front, {}));
  EXPECT_EQ(parts_.repetition.moves_m().size(), 3u);
  expectDirectionsOfTheirOwn(parts_.repetition.moves_m(), kPeriodPx);
}

TEST_F(RepetitionTest, SaysWhatRepeats) {
  const auto repeating = [&] {
    uint32_t count = 0;
    for (uint32_t i = 0; i < parts_.front.liftedCount(); ++i) count += parts_.repetition.repeats(i);
    return static_cast<double>(count) / parts_.front.liftedCount();
  };
  parts_.see(0);
  ASSERT_TRUE(parts_.repetition.look(parts_.front, {}));
  const double without_pattern = repeating();  // its walls have spots, which are alike
  parts_.seeRepeated(0, 64);
  ASSERT_TRUE(parts_.repetition.look(parts_.front, {}));
  EXPECT_LT(without_pattern, 0.6);
  EXPECT_GT(repeating(), 0.8);
}

TEST_F(RepetitionTest, SameInPieces) {
  for (const uint32_t pieces : {2u, 3u, 8u}) {
    uint32_t calls = 0;
    const Parallel parallel = test::backwards(pieces, &calls);
    Repetition cut;
    const test::ArenaMemory memory([&](Arena &arena, bool real) {
      Repetition::layout(parts_.config.max_keypoints, parallel, arena, real ? &cut : nullptr);
    });
    cut.setParallel(parallel);
    for (const uint32_t period_px : {48u, 64u}) {
      parts_.seeRepeated(0, period_px);
      ASSERT_TRUE(parts_.repetition.look(parts_.front, {}));
      ASSERT_TRUE(cut.look(parts_.front, {}));
      const Span<const Vector3> alone = parts_.repetition.moves_m(), found = cut.moves_m();
      ASSERT_EQ(found.size(), alone.size());
      for (size_t i = 0; i < alone.size(); ++i) EXPECT_EQ(found[i], alone[i]);
      for (uint32_t i = 0; i < parts_.front.liftedCount(); ++i)
        EXPECT_EQ(cut.repeats(i), parts_.repetition.repeats(i));
    }
    EXPECT_GE(calls, 4u);
  }
}

TEST_F(RepetitionTest, EndsWithTheDeadline) {
  parts_.seeRepeated(0, 64);
  const Clock late = {[](void *) { return int64_t{10}; }, nullptr};
  EXPECT_FALSE(parts_.repetition.look(parts_.front, Deadline::after(late, 0, 1)));
  EXPECT_TRUE(parts_.repetition.moves_m().empty());
}

}  // namespace
}  // namespace sphc
