#include "host/audit/score/auc.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "runtime/base/random.h"

namespace sphc::host {
namespace {

TEST(Auc, OfFewByHand) {
  EXPECT_EQ(areaUnderCurve({1, 2, 3, 4}, {false, false, true, true}).value, 1);
  EXPECT_EQ(areaUnderCurve({1, 2, 3, 4}, {true, true, false, false}).value, 0);
  EXPECT_EQ(areaUnderCurve({1, 3, 2, 4}, {false, false, true, true}).value, 0.75);
  EXPECT_EQ(areaUnderCurve({5, 5, 5}, {true, false, true}).value, 0.5);  // ties
  EXPECT_EQ(areaUnderCurve({1, 2}, {true, true}).value, 0.5);
}

// Of scores that tell nothing, a third of them of positives.
struct Chance {
  double spread = 0;  // of the area, over many draws
  double standard_error = 0, chance_error = 0;
  double least_ratio = 1e9;  // of the former to the latter, in any draw
};

template <typename Score>
Chance chanceOf(int count, const Score &score) {
  constexpr int kRounds = 400;
  double squares = 0;
  Chance chance;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<double> scores;
    std::vector<bool> positive;
    for (int i = 0; i < count; ++i) {
      scores.push_back(score());
      positive.push_back(i % 3 == 0);
    }
    const Auc auc = areaUnderCurve(scores, positive);
    squares += (auc.value - 0.5) * (auc.value - 0.5) / kRounds;
    chance.standard_error += auc.standard_error / kRounds;
    chance.chance_error += auc.chance_error / kRounds;
    chance.least_ratio = std::min(chance.least_ratio, auc.standard_error / auc.chance_error);
  }
  chance.spread = std::sqrt(squares);
  return chance;
}

TEST(Auc, StandardErrorIsThatOfChance) {
  Random random(1);
  const Chance chance = chanceOf(90, [&random] { return random.uniform(); });
  EXPECT_NEAR(chance.standard_error, chance.spread, 0.01);
}

// Few of many entries score apart from the others, which all score the same.
TEST(Auc, ChanceErrorKnowsOfTies) {
  Random random(1);
  const Chance chance = chanceOf(900, [&random] { return random.below(20) == 0 ? 1.0 : 0.0; });
  EXPECT_GT(chance.least_ratio, 2);
  EXPECT_NEAR(chance.chance_error, chance.spread, 0.001);
  EXPECT_EQ(areaUnderCurve({5, 5, 5}, {true, false, true}).chance_error, 0);
}

}  // namespace
}  // namespace sphc::host
