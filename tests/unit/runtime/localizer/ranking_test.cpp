#include "runtime/localizer/ranking.h"

#include <gtest/gtest.h>

namespace sphc {
namespace {

// Of a camera this far from the map's centre.
Hypothesis hypothesisAt(double x_m, double gain, Outcome outcome = Outcome::kLocalized) {
  Hypothesis hypothesis;
  hypothesis.outcome = outcome;
  hypothesis.estimate.camera_from_map.translation_m = {x_m, 0, 0};
  hypothesis.estimate.gain = gain;
  hypothesis.estimate.inliers = 20;
  hypothesis.evidence.log_chance_first = -20;
  hypothesis.evidence.log_chance_second = -30;
  return hypothesis;
}

std::vector<double> gainsOf(const Ranking &ranking) {
  std::vector<double> gains;
  for (const RankedPose &pose : ranking.poses()) gains.push_back(pose.gain);
  return gains;
}

TEST(Ranking, WhatGainsMostComesFirst) {
  Ranking ranking;
  for (double gain : {3, 9, 1, 5}) ranking.add(hypothesisAt(gain, gain), 7);
  EXPECT_EQ(gainsOf(ranking), (std::vector<double>{9, 5, 3, 1}));
  EXPECT_EQ(ranking.poses()[0].camera_from_map.translation_m.x(), 9);
  EXPECT_EQ(ranking.poses()[0].map_id, 7u);
  EXPECT_EQ(ranking.poses()[0].inliers, 20u);
  EXPECT_EQ(ranking.poses()[0].log_chance, -50);
  ranking.clear();
  EXPECT_TRUE(ranking.poses().empty());
}

TEST(Ranking, APoseThatIsFoundAgainStaysOne) {
  Ranking ranking;
  ranking.add(hypothesisAt(0, 4), 1);
  ranking.add(hypothesisAt(5, 3), 1);
  ranking.add(hypothesisAt(0.1, 2), 1);  // within 15 cm of the first
  ranking.add(hypothesisAt(5.1, 6), 1);
  EXPECT_EQ(gainsOf(ranking), (std::vector<double>{6, 4}));
  ranking.add(hypothesisAt(0, 5), 2);  // another map
  EXPECT_EQ(gainsOf(ranking), (std::vector<double>{6, 5, 4}));
}

TEST(Ranking, WhatChanceExplainsIsLeftOut) {
  Ranking ranking;
  ranking.add(hypothesisAt(0, 4, Outcome::kNoConsensus), 1);
  EXPECT_TRUE(ranking.poses().empty());
  ranking.add(hypothesisAt(0, 4, Outcome::kUncertain), 1);
  EXPECT_EQ(ranking.poses().size(), 1u);
}

TEST(Ranking, WhereItIsFullTheLastGivesWay) {
  Ranking ranking;
  for (uint32_t i = 0; i < Ranking::kMost; ++i) ranking.add(hypothesisAt(i, 10 + i), 1);
  ranking.add(hypothesisAt(20, 9), 1);
  EXPECT_EQ(gainsOf(ranking).back(), 10);
  ranking.add(hypothesisAt(20, 12.5), 1);
  ASSERT_EQ(ranking.poses().size(), size_t{Ranking::kMost});
  EXPECT_EQ(gainsOf(ranking), (std::vector<double>{17, 16, 15, 14, 13, 12.5, 12, 11}));
}

TEST(Ranking, TheAnswerIsMarked) {
  Ranking ranking;
  ranking.add(hypothesisAt(0, 4), 1);
  ranking.add(hypothesisAt(5, 6), 1);
  ranking.markAnswer(hypothesisAt(0, 4).estimate.camera_from_map, 2);
  EXPECT_FALSE(ranking.poses()[0].is_answer || ranking.poses()[1].is_answer);
  ranking.markAnswer(hypothesisAt(0, 4).estimate.camera_from_map, 1);
  EXPECT_FALSE(ranking.poses()[0].is_answer);
  EXPECT_TRUE(ranking.poses()[1].is_answer);
}

}  // namespace
}  // namespace sphc
