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

}  // namespace
}  // namespace sphc::host
