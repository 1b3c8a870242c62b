#include "lab/match/bench.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "lab/match/table.h"
#include "tests/support/map_bytes.h"
#include "tests/support/random_numbers.h"

namespace sphc::host {
namespace {

constexpr uint32_t kExtractor = 7;

std::vector<MatchPoint> randomPoints(size_t count) {
  Random random(3);
  std::vector<MatchPoint> points;
  for (size_t i = 0; i < count; ++i) {
    const Vector3 direction = test::randomDirection(&random);
    points.push_back({direction, test::randomDescriptor(&random)});
  }
  return points;
}

MatchCase caseOf(const std::vector<MatchPoint> &points, const std::vector<MatchPoint> &queries) {
  std::vector<test::MapPoint> map;
  for (const MatchPoint &p : points) map.push_back({p.direction, p.descriptor});
  return makeMatchCase(test::encodeIndexedMap(map, 6, kExtractor), kExtractor, 0, queries);
}

bool same(const Descriptor &a, const Descriptor &b) { return std::memcmp(&a, &b, kDescriptorBytes) == 0; }

TEST(MatchCase, TransformsAreThoseOfTheSquare) {
  Random random(1);
  const Descriptor d = test::randomDescriptor(&random);
  EXPECT_TRUE(same(transformed(d, 0), d));
  EXPECT_TRUE(same(transformed(transformed(d, 1), 1), d));  // a mirror twice
  EXPECT_TRUE(same(transformed(transformed(d, 2), 6), d));  // a quarter and three
  EXPECT_TRUE(same(transformed(transformed(d, 4), 4), d));  // a half twice
  for (uint32_t a = 0; a < 8; ++a)
    for (uint32_t b = 0; b < a; ++b) EXPECT_FALSE(same(transformed(d, a), transformed(d, b))) << a << " " << b;
}

TEST(MatchCase, GrownMapsHoldTheRealPointsAndAreTheSameEachTime) {
  const auto points = randomPoints(50);
  const auto grown = grownPoints(points, 200, 5), again = grownPoints(points, 200, 5);
  ASSERT_EQ(grown.size(), 200u);
  size_t real = 0;
  for (size_t i = 0; i < grown.size(); ++i) {
    EXPECT_TRUE(same(grown[i].descriptor, again[i].descriptor));
    EXPECT_NEAR(grown[i].direction.norm(), 1, 1e-12);
    for (const MatchPoint &p : points) real += same(p.descriptor, grown[i].descriptor);
  }
  EXPECT_EQ(real, 50u);
  EXPECT_EQ(grownPoints(points, 20, 5).size(), 20u);
}

TEST(MatchCase, WhatIsNoMapIsRefused) {
  EXPECT_THROW(makeMatchCase(std::vector<uint8_t>(100), kExtractor, 0, {}), std::runtime_error);
}

TEST(MatchBench, TheExactAnswerIsPerfectAndAWrongOneIsNot) {
  const auto points = randomPoints(300);
  const std::vector<MatchPoint> queries(points.begin(), points.begin() + 40);
  const MatchCase c = caseOf(points, queries);
  double candidates = 0;
  const auto exact = exactTopTwo(c, 0, &candidates);
  EXPECT_EQ(candidates, 300);
  MatchQuality quality = judgeMatches(c, exact, exact);
  EXPECT_EQ(quality.recall1, 1);
  EXPECT_EQ(quality.ratio_recall, 1);
  EXPECT_EQ(quality.accepted, 40u);
  EXPECT_EQ(quality.correct, 40u);
  auto half = exact;
  for (size_t q = 0; q < 20; ++q) half[q].index = -1;
  quality = judgeMatches(c, half, exact);
  EXPECT_EQ(quality.recall1, 0.5);
  EXPECT_EQ(quality.ratio_recall, 0.5);
  EXPECT_EQ(quality.accepted, 20u);
  auto unsure = exact;
  for (TopTwo &two : unsure) {
    two.best = 200;
    two.second = 210;
  }
  quality = judgeMatches(c, unsure, exact);
  EXPECT_EQ(quality.recall1, 1);
  EXPECT_EQ(quality.ratio_recall, 0);
}

TEST(MatchBench, ACapLeavesOthersOut) {
  const auto points = randomPoints(300);
  const MatchCase c = caseOf(points, {points.begin(), points.begin() + 40});
  double candidates = 0;
  exactTopTwo(c, 30, &candidates);
  EXPECT_NEAR(candidates, 300 * (1 - std::cos(30 * kPi / 180)) / 2, 8);
}

TEST(MatchBench, OurExactMatcherEqualsTheReference) {
  const auto points = randomPoints(300);
  std::vector<MatchVariant> variants = ourMatchVariants();
  MatchVariant absent;
  absent.name = "absent";
  absent.absent = "nowhere";
  variants.push_back(absent);
  MatchVariant small = variants[0];
  small.largest_map = 299;
  variants.push_back(small);
  const MatchCase c = caseOf(points, {points.begin(), points.begin() + 40});
  const MatchTable table = runMatchBench(c, variants, 2, nullptr);
  ASSERT_EQ(table.rows.size(), variants.size() - 2);
  EXPECT_EQ(table.rows[0].name, kExactName);
  EXPECT_EQ(table.rows[0].quality.ratio_recall, 1);
  EXPECT_EQ(table.rows[0].quality.recall1, 1);
  for (const MatchRow &row : table.rows) {
    EXPECT_GT(row.time_ms, 0);
    EXPECT_TRUE(std::isnan(row.times_faster_than_ivf));  // nothing to compare with
  }
  EXPECT_EQ(matchResults({table}).find("time_ms"), std::string::npos);
  EXPECT_NE(matchCsv({table}).find("time_ms"), std::string::npos);
  EXPECT_NE(matchTableText(table).find("ours, guided 3 deg"), std::string::npos);
  EXPECT_EQ(matchJson({table})[0]["matchers"].size(), table.rows.size());
}

TEST(MatchBench, APeerWithoutItsPythonIsToldWithTheCure) {
  for (const MatchVariant &peer : pythonMatchPeers("/nonexistent/python")) {
    EXPECT_FALSE(peer.prepare);
    EXPECT_NE(peer.absent.find("pip install"), std::string::npos);
  }
}

}  // namespace
}  // namespace sphc::host
