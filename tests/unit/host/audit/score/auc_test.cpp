#include "host/audit/score/auc.h"

#include <gtest/gtest.h>

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

TEST(Auc, StandardErrorIsThatOfChance) {
  Random random(1);
  double squares = 0, error = 0;
  constexpr int kRounds = 400;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<double> scores;
    std::vector<bool> positive;
    for (int i = 0; i < 90; ++i) {
      scores.push_back(random.uniform());
      positive.push_back(i % 3 == 0);
    }
    const Auc auc = areaUnderCurve(scores, positive);
    squares += (auc.value - 0.5) * (auc.value - 0.5) / kRounds;
    error += auc.standard_error / kRounds;
  }
  EXPECT_NEAR(error, std::sqrt(squares), 0.01);
}

// Few of many entries score apart from the others, which all score the same.
TEST(Auc, ChanceErrorKnowsOfTies) {
  Random random(1);
  double squares = 0, error = 0;
  constexpr int kRounds = 400;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<double> scores;
    std::vector<bool> positive;
    for (int i = 0; i < 900; ++i) {
      scores.push_back(random.below(20) == 0);
      positive.push_back(i % 3 == 0);
    }
    const Auc auc = areaUnderCurve(scores, positive);
    squares += (auc.value - 0.5) * (auc.value - 0.5) / kRounds;
    error += auc.chance_error / kRounds;
    EXPECT_GT(auc.standard_error, 2 * auc.chance_error);
  }
  EXPECT_NEAR(error, std::sqrt(squares), 0.001);
  EXPECT_EQ(areaUnderCurve({5, 5, 5}, {true, false, true}).chance_error, 0);
}

}  // namespace
}  // namespace sphc::host
