#include "host/audit/score/real_or_fake_scores.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sphc::host {
namespace {

TEST(RealOrFakeScores, TheStrongestComesLastAndRowsSayWhose) {
  const auto scores = scoreRealOrFake({{"weak", {1, 4, 2, 3}}, {"good", {4, 3, 1, 2}}}, {true, true, false, false});
  ASSERT_EQ(scores.size(), 3u);
  EXPECT_EQ(scores[0].auc, 0.5);
  EXPECT_EQ(scores[1].auc, 1);
  EXPECT_EQ(scores[1].precision_at_eta, 1);
  EXPECT_EQ(scores[2].attacker, "strongest");
  EXPECT_EQ(scores[2].auc, 1);
  const auto rows = realOrFakeRows(scores, "room", "gaussian", 0.5);
  ASSERT_EQ(rows.size(), 9u);
  EXPECT_EQ(rows[8].attack, "real_or_fake");
  EXPECT_EQ(rows[8].variant, "strongest");
  EXPECT_EQ(rows[8].metric, "precision_at_tenth");
}

TEST(RealOrFakeScores, TheStrongestIsTheMostOfEachFigure) {
  // One is best at the top and wrong below; the other is rather right everywhere.
  const std::vector<double> top = {20, 1, 2, 3, 4, 5, 6, 7, 8, 9}, all = {5, 9, 8, 7, 6, 4, 3, 2, 1, 10};
  const std::vector<bool> real = {true, true, true, true, true, false, false, false, false, false};
  const auto scores = scoreRealOrFake({{"top", top}, {"all", all}}, real);
  EXPECT_EQ(scores[2].auc, scores[1].auc);
  EXPECT_GT(scores[1].auc, scores[0].auc);
  EXPECT_EQ(scores[2].precision_at_tenth, 1);
  EXPECT_EQ(scores[1].precision_at_tenth, 0);
}

TEST(RealOrFakeScores, ACueThatPointsTheOtherWayIsTurnedAndWhatWasLearnedIsNot) {
  std::vector<RealOrFakeGuess> guesses = {
      {"cue", {1, 2, 3, 4}, true}, {"right cue", {4, 3, 2, 1}, true}, {"learned", {1, 2, 3, 4}}};
  turnCues({true, true, false, false}, &guesses);
  EXPECT_EQ(guesses[0].scores, (std::vector<double>{-1, -2, -3, -4}));
  EXPECT_EQ(guesses[1].scores, (std::vector<double>{4, 3, 2, 1}));
  EXPECT_EQ(guesses[2].scores, (std::vector<double>{1, 2, 3, 4}));
}

TEST(RealOrFakeScores, LayersAreToldByTheirMeans) {
  const auto scores =
      scoreRealOrFake({{"noisy", {1, 9, 2, 6, 3, 4}}}, {true, true, true, false, false, false}, {0, 0, 0, 1, 2, 2});
  EXPECT_NEAR(scores[0].auc_of_layers, 2.0 / 3, 1e-9);  // 4 against 6, 3.5 and 3.5
  EXPECT_LT(scores[0].auc, scores[0].auc_of_layers);
  EXPECT_EQ(realOrFakeRows(scores, "room", "patchwork", 0.5).size(), 8u);  // two attackers, four figures
}

}  // namespace
}  // namespace sphc::host
