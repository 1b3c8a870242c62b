#include "runtime/stages/match/matcher.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "runtime/stages/features/extractor.h"
#include "tests/support/map_bytes.h"
#include "tests/support/random_numbers.h"

namespace sphc {
namespace {

Descriptor jittered(const Descriptor &base, int amount, Random *random) {
  Descriptor d = base;
  for (uint8_t &byte : d.bytes) {
    const int value = byte + static_cast<int>(random->below(static_cast<uint32_t>(2 * amount + 1))) - amount;
    byte = static_cast<uint8_t>(value < 0 ? 0 : value > 255 ? 255 : value);
  }
  return d;
}

class MatcherTest : public testing::Test {
 protected:
  static constexpr uint32_t kMap = 600, kQueries = 120;

  void SetUp() override {
    for (uint32_t i = 0; i < kMap; ++i) {
      const Vector3 direction = test::randomDirection(&random_);
      points_.push_back({direction, test::randomDescriptor(&random_)});
    }
    Arena measure;
    Matcher::layout(kQueries, measure, nullptr);
    memory_.resize(measure.used() + kArenaAlignment);
    uint8_t *start = memory_.data();
    while (reinterpret_cast<uintptr_t>(start) % kArenaAlignment) ++start;
    Arena arena(start);
    Matcher::layout(kQueries, arena, &matcher_);
    matches_.resize(kQueries);
  }
  const MapView &view() {
    file_ = test::encodeMap(points_, kExtractorId);
    EXPECT_EQ(MapView::open(file_.data(), file_.size(), kExtractorId, &view_, nullptr), SPHC_OK);
    return view_;
  }
  std::vector<Match> matchAll(const std::vector<Descriptor> &queries, float ratio) {
    const uint32_t n =
        matcher_.matchAll(view(), {queries.data(), queries.size()}, ratio, {matches_.data(), kQueries});
    return {matches_.begin(), matches_.begin() + n};
  }
  std::vector<Match> matchNear(const std::vector<Descriptor> &queries, const std::vector<Vector3> &expected,
                               double degrees, float ratio) {
    std::vector<Direction> directions;
    for (const Vector3 &d : expected)
      directions.push_back({static_cast<float>(d.x()), static_cast<float>(d.y()), static_cast<float>(d.z())});
    const uint32_t n =
        matcher_.matchNear(view(), {queries.data(), queries.size()}, {directions.data(), directions.size()},
                           static_cast<float>(std::cos(degrees * kPi / 180)), ratio, {matches_.data(), kQueries});
    return {matches_.begin(), matches_.begin() + n};
  }

  Random random_{11};
  std::vector<test::MapPoint> points_;
  std::vector<uint8_t> file_, memory_;
  MapView view_;
  Matcher matcher_;
  std::vector<Match> matches_;
};

TEST_F(MatcherTest, FindsTheExactNearest) {
  std::vector<Descriptor> queries;
  for (uint32_t q = 0; q < kQueries; ++q) queries.push_back(jittered(points_[3 * q].descriptor, 12, &random_));
  const std::vector<Match> matches = matchAll(queries, 0.8f);
  ASSERT_EQ(matches.size(), kQueries);
  for (const Match &m : matches) {
    EXPECT_EQ(m.map_index, 3 * m.query);
    EXPECT_EQ(m.distance2, distance2Scalar(queries[m.query], points_[m.map_index].descriptor));
    EXPECT_LE(m.distance2, m.second2);
  }
}

TEST_F(MatcherTest, BestRatioFirst) {
  std::vector<Descriptor> queries;
  for (uint32_t q = 0; q < 50; ++q)
    queries.push_back(jittered(points_[q].descriptor, 2 + static_cast<int>(q), &random_));
  const std::vector<Match> matches = matchAll(queries, 1.0f);
  for (size_t i = 1; i < matches.size(); ++i)
    EXPECT_LE(1.0 * matches[i - 1].distance2 / matches[i - 1].second2,
              1.0 * matches[i].distance2 / matches[i].second2);
}

TEST_F(MatcherTest, TwinsFailTheRatioTest) {
  points_[1].descriptor = points_[0].descriptor;
  const std::vector<Descriptor> queries = {jittered(points_[0].descriptor, 3, &random_)};
  EXPECT_EQ(matchAll(queries, 0.8f).size(), 0u);
}

TEST_F(MatcherTest, TheRatioIsOfDistancesNotOfSquares) {
  Descriptor base = points_[0].descriptor;
  for (uint8_t &byte : base.bytes) byte = 100;
  points_[0].descriptor = points_[1].descriptor = base;
  points_[0].descriptor.bytes[0] = 100 + 7;   // 7 away
  points_[1].descriptor.bytes[0] = 100 + 10;  // 10 away
  const std::vector<Descriptor> queries = {base};
  EXPECT_EQ(matchAll(queries, 0.71f).size(), 1u);
  EXPECT_EQ(matchAll(queries, 0.69f).size(), 0u);
}

TEST_F(MatcherTest, OneQueryForEachMapPointTheNearest) {
  const std::vector<Descriptor> queries = {jittered(points_[5].descriptor, 20, &random_),
                                           jittered(points_[5].descriptor, 4, &random_),
                                           jittered(points_[5].descriptor, 12, &random_)};
  const std::vector<Match> matches = matchAll(queries, 0.8f);
  ASSERT_EQ(matches.size(), 1u);
  EXPECT_EQ(matches[0].query, 1u);
  EXPECT_EQ(matches[0].map_index, 5u);
}

TEST_F(MatcherTest, StrangersDoNotMatch) {
  std::vector<Descriptor> queries;
  for (uint32_t q = 0; q < kQueries; ++q) queries.push_back(test::randomDescriptor(&random_));
  EXPECT_EQ(matchAll(queries, 0.95f).size(), 0u);
}

TEST_F(MatcherTest, NoQueries) { EXPECT_EQ(matchAll({}, 0.8f).size(), 0u); }

TEST_F(MatcherTest, GuidedLooksInsideTheCapAlone) {
  // A distant twin spoils the ratio test of the whole map; the cap of 3 degrees leaves it out.
  points_[0].direction = Vector3(0, 0, 1);
  points_[1] = {Vector3(1, 0, 0), points_[0].descriptor};
  const std::vector<Descriptor> queries = {jittered(points_[0].descriptor, 3, &random_)};
  EXPECT_EQ(matchAll(queries, 0.8f).size(), 0u);
  const std::vector<Match> near = matchNear(queries, {Vector3(0.02, 0, 1).normalized()}, 3, 0.8f);
  ASSERT_EQ(near.size(), 1u);
  EXPECT_EQ(near[0].map_index, 0u);
  const std::vector<Match> twin = matchNear(queries, {Vector3(1, 0.02, 0).normalized()}, 3, 0.8f);
  ASSERT_EQ(twin.size(), 1u);
  EXPECT_EQ(twin[0].map_index, 1u);
  EXPECT_EQ(matchNear(queries, {Vector3(0, -1, 0)}, 3, 0.8f).size(), 0u);
}

TEST_F(MatcherTest, GuidedEqualsExhaustiveWithinTheCap) {
  std::vector<Descriptor> queries;
  std::vector<Vector3> expected;
  for (uint32_t q = 0; q < kQueries; ++q) {
    queries.push_back(jittered(points_[q].descriptor, 10, &random_));
    expected.push_back((points_[q].direction + 0.02 * test::normalVector(&random_)).normalized());
  }
  const std::vector<Match> matches = matchNear(queries, expected, 6, 1.0f);
  EXPECT_GT(matches.size(), kQueries * 9 / 10);
  for (const Match &m : matches)
    for (uint32_t i = 0; i < kMap; ++i) {
      if (points_[i].direction.dot(expected[m.query]) < std::cos(6.01 * kPi / 180)) continue;
      EXPECT_GE(distance2Scalar(points_[i].descriptor, queries[m.query]) + 1, m.distance2);
    }
}

}  // namespace
}  // namespace sphc
