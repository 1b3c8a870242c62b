#include "runtime/stages/match/matcher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "runtime/stages/features/extractor.h"
#include "tests/support/arena_memory.h"
#include "tests/support/backwards.h"
#include "tests/support/map_bytes.h"
#include "tests/support/random_numbers.h"
#include "tests/support/stepping_clock.h"

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
    Arena arena(test::alignedStart(&memory_));
    Matcher::layout(kQueries, arena, &matcher_);
    matches_.resize(kQueries);
  }
  const MapView &view() {
    file_ = test::encodeMap(points_, kExtractorId);
    EXPECT_EQ(MapView::open(file_.data(), file_.size(), kExtractorId, &view_, nullptr), SPHC_OK);
    return view_;
  }
  std::vector<Match> matchExact(const std::vector<Descriptor> &queries, float ratio) {
    matcher_.ask(view(), {queries.data(), queries.size()}, 8);
    const uint32_t n = matcher_.matchExact(ratio, {matches_.data(), kQueries});
    return {matches_.begin(), matches_.begin() + n};
  }
  std::vector<Match> matchNear(const std::vector<Descriptor> &queries, const std::vector<Vector3> &expected,
                               double degrees, float ratio) {
    std::vector<Direction> directions;
    for (const Vector3 &d : expected)
      directions.push_back({static_cast<float>(d.x()), static_cast<float>(d.y()), static_cast<float>(d.z())});
    matcher_.ask(view(), {queries.data(), queries.size()}, 8);
    const uint32_t n =
        matcher_.matchNear({directions.data(), directions.size()},
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
  const std::vector<Match> matches = matchExact(queries, 0.8f);
  ASSERT_EQ(matches.size(), kQueries);
  for (const Match &m : matches) {
    EXPECT_EQ(m.point_index, 3 * m.query);
    EXPECT_EQ(m.distance2, distance2Scalar(queries[m.query], points_[m.point_index].descriptor));
    EXPECT_LE(m.distance2, m.second2);
  }
}

TEST_F(MatcherTest, BestRatioFirst) {
  std::vector<Descriptor> queries;
  for (uint32_t q = 0; q < 50; ++q)
    queries.push_back(jittered(points_[q].descriptor, 2 + static_cast<int>(q), &random_));
  const std::vector<Match> matches = matchExact(queries, 1.0f);
  ASSERT_GT(matches.size(), 40u);
  for (size_t i = 1; i < matches.size(); ++i)
    EXPECT_LE(1.0 * matches[i - 1].distance2 / matches[i - 1].second2,
              1.0 * matches[i].distance2 / matches[i].second2);
}

TEST_F(MatcherTest, NearDuplicatesFailTheRatioTest) {
  points_[1].descriptor = points_[0].descriptor;
  const std::vector<Descriptor> queries = {jittered(points_[0].descriptor, 3, &random_)};
  EXPECT_EQ(matchExact(queries, 0.8f).size(), 0u);
}

TEST_F(MatcherTest, TheRatioIsOfDistancesNotOfSquares) {
  Descriptor base = points_[0].descriptor;
  for (uint8_t &byte : base.bytes) byte = 100;
  points_[0].descriptor = points_[1].descriptor = base;
  points_[0].descriptor.bytes[0] = 100 + 7;   // 7 away
  points_[1].descriptor.bytes[0] = 100 + 10;  // 10 away
  const std::vector<Descriptor> queries = {base};
  EXPECT_EQ(matchExact(queries, 0.71f).size(), 1u);
  EXPECT_EQ(matchExact(queries, 0.69f).size(), 0u);
}

TEST_F(MatcherTest, OneQueryForEachMapPointTheNearest) {
  const std::vector<Descriptor> queries = {jittered(points_[5].descriptor, 20, &random_),
                                           jittered(points_[5].descriptor, 4, &random_),
                                           jittered(points_[5].descriptor, 12, &random_)};
  const std::vector<Match> matches = matchExact(queries, 0.8f);
  ASSERT_EQ(matches.size(), 1u);
  EXPECT_EQ(matches[0].query, 1u);
  EXPECT_EQ(matches[0].point_index, 5u);
}

TEST_F(MatcherTest, StrangersDoNotMatch) {
  std::vector<Descriptor> queries;
  for (uint32_t q = 0; q < kQueries; ++q) queries.push_back(test::randomDescriptor(&random_));
  EXPECT_EQ(matchExact(queries, 0.95f).size(), 0u);
}

// All that a matcher says of some queries.
std::vector<Match> allMatches(const MapView &view, const std::vector<Descriptor> &queries,
                              const std::vector<Direction> &expected, Matcher *matcher) {
  std::vector<Match> all, room(queries.size());
  const Span<Match> to(room.data(), room.size());
  const auto add = [&](uint32_t count) { all.insert(all.end(), room.begin(), room.begin() + count); };
  matcher->ask(view, {queries.data(), queries.size()}, 8);
  add(matcher->matchAll(7, 0.9f, to));
  add(matcher->matchNear({expected.data(), expected.size()}, 0.7f, 0.9f, to));
  add(matcher->matchAll(queries.size(), 0.9f, to));
  add(matcher->matchExact(0.9f, to));
  return all;
}

TEST_F(MatcherTest, SameInPieces) {
  std::vector<Descriptor> queries;
  std::vector<Direction> expected;
  points_[100].descriptor = points_[400].descriptor;  // of equals the first one is found
  for (uint32_t q = 0; q < kQueries; ++q) {
    const test::MapPoint &point = points_[4 * q];
    queries.push_back(jittered(point.descriptor, q % 40, &random_));
    if (q > 100) continue;
    expected.push_back({static_cast<float>(point.direction.x()), static_cast<float>(point.direction.y()),
                        static_cast<float>(point.direction.z())});
  }
  const std::vector<Match> alone = allMatches(view(), queries, expected, &matcher_);
  EXPECT_GT(alone.size(), 2 * kQueries);
  for (const uint32_t pieces : {2u, 3u, 8u}) {
    uint32_t calls = 0;
    const Parallel parallel = test::backwards(pieces, &calls);
    Matcher cut;
    const test::ArenaMemory memory(
        [&](Arena &arena, bool real) { Matcher::layout(kQueries, arena, real ? &cut : nullptr, parallel); });
    cut.setParallel(parallel);
    const std::vector<Match> found = allMatches(view(), queries, expected, &cut);
    ASSERT_EQ(found.size(), alone.size());
    EXPECT_EQ(std::memcmp(found.data(), alone.data(), alone.size() * sizeof(Match)), 0);
    EXPECT_EQ(calls, 2u + 1 + 2 + 1);  // cells are ranked for as long as there are new queries
  }
}

// Both may lie in a piece that is not the first.
TEST_F(MatcherTest, NearDuplicatesFailTheRatioTestInPiecesToo) {
  points_[kMap - 1].descriptor = points_[kMap - 2].descriptor;
  const std::vector<Descriptor> queries = {jittered(points_[kMap - 1].descriptor, 3, &random_)};
  const Parallel parallel = test::backwards(3);
  Matcher cut;
  const test::ArenaMemory memory(
      [&](Arena &arena, bool real) { Matcher::layout(kQueries, arena, real ? &cut : nullptr, parallel); });
  cut.setParallel(parallel);
  cut.ask(view(), {queries.data(), queries.size()}, 8);
  EXPECT_EQ(cut.matchExact(0.8f, {matches_.data(), kQueries}), 0u);
}

TEST_F(MatcherTest, NoQueries) { EXPECT_EQ(matchExact({}, 0.8f).size(), 0u); }

TEST_F(MatcherTest, GuidedMatchesInsideTheConeAlone) {
  // A distant near-duplicate spoils the ratio test of the whole map; the cone of 3 degrees leaves it out.
  points_[0].direction = Vector3(0, 0, 1);
  points_[1] = {Vector3(1, 0, 0), points_[0].descriptor};
  const std::vector<Descriptor> queries = {jittered(points_[0].descriptor, 3, &random_)};
  EXPECT_EQ(matchExact(queries, 0.8f).size(), 0u);
  const std::vector<Match> near = matchNear(queries, {Vector3(0.02, 0, 1).normalized()}, 3, 0.8f);
  ASSERT_EQ(near.size(), 1u);
  EXPECT_EQ(near[0].point_index, 0u);
  const std::vector<Match> second = matchNear(queries, {Vector3(1, 0.02, 0).normalized()}, 3, 0.8f);
  ASSERT_EQ(second.size(), 1u);
  EXPECT_EQ(second[0].point_index, 1u);
  EXPECT_EQ(matchNear(queries, {Vector3(0, -1, 0)}, 3, 0.8f).size(), 0u);
}

TEST_F(MatcherTest, GuidedEqualsExhaustiveWithinTheCone) {
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

// The same points behind an index of many cells.
class IndexedMatcherTest : public MatcherTest {
 protected:
  void SetUp() override {
    MatcherTest::SetUp();
    useCells(40);
    for (uint32_t q = 0; q < kQueries; ++q) queries_.push_back(jittered(points_[3 * q].descriptor, 25, &random_));
  }
  void useCells(uint32_t cells) {
    file_ = test::encodeIndexedMap(points_, cells, kExtractorId);
    ASSERT_EQ(MapView::open(file_.data(), file_.size(), kExtractorId, &view_, nullptr), SPHC_OK);
  }
  Span<const Descriptor> queries() const { return {queries_.data(), queries_.size()}; }
  Span<Match> room() { return {matches_.data(), kQueries}; }
  std::vector<Match> taken(uint32_t count) const { return {matches_.begin(), matches_.begin() + count}; }
  std::vector<Match> exactly(float ratio) {
    matcher_.ask(view_, queries(), 8);
    return taken(matcher_.matchExact(ratio, room()));
  }
  std::vector<Match> all(const MapView &map, Span<const Descriptor> queries, float ratio, uint32_t probes) {
    matcher_.ask(map, queries, probes);
    return taken(matcher_.matchAll(queries.size(), ratio, room()));
  }

  // Where the points lie that the queries are of.
  std::vector<Direction> expectedDirections() const {
    std::vector<Direction> expected;
    for (uint32_t q = 0; q < kQueries; ++q) {
      const Vector3 &d = points_[3 * q].direction;
      expected.push_back({static_cast<float>(d.x()), static_cast<float>(d.y()), static_cast<float>(d.z())});
    }
    return expected;
  }

  std::vector<Descriptor> queries_;
};

bool same(const Match &a, const Match &b) {
  return a.query == b.query && a.point_index == b.point_index && a.distance2 == b.distance2 &&
         a.second2 == b.second2;
}

bool same(const std::vector<Match> &a, const std::vector<Match> &b) {
  return a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(), [](const Match &x, const Match &y) { return same(x, y); });
}

TEST_F(IndexedMatcherTest, AllCellsProbedIsExact) {
  useCells(8);  // few enough that every group of them is looked at
  const auto exact = exactly(0.9f);
  EXPECT_EQ(exact.size(), kQueries);
  for (const uint32_t probes : {8u, 32u, 1000u})
    EXPECT_TRUE(same(exact, all(view_, queries(), 0.9f, probes))) << probes;
}

TEST_F(IndexedMatcherTest, MoreProbesFindMoreOfTheExactMatches) {
  const auto exact = exactly(0.9f);
  size_t before = 0;
  for (const uint32_t probes : {0u, 1u, 4u, 16u, 32u}) {
    size_t found = 0;
    for (const Match &m : all(view_, queries(), 0.9f, probes))
      for (const Match &other : exact) found += m.query == other.query && m.point_index == other.point_index;
    EXPECT_GE(found, before) << probes;
    before = found;
  }
  EXPECT_GT(before, exact.size() / 2);
}

TEST_F(IndexedMatcherTest, OneMatcherServesSeveralMaps) {
  const auto first = all(view_, queries(), 0.9f, 8);
  ASSERT_FALSE(first.empty());
  const std::vector<uint8_t> other_file = test::randomMap(500, 99);
  MapView other;
  ASSERT_EQ(MapView::open(other_file.data(), other_file.size(), kExtractorId, &other, nullptr), SPHC_OK);
  EXPECT_TRUE(all(other, queries(), 0.8f, 8).empty());
  EXPECT_TRUE(same(first, all(view_, queries(), 0.9f, 8)));
}

TEST_F(IndexedMatcherTest, AQueryAloneFindsWhatItFindsAmongOthers) {
  const auto together = all(view_, queries(), 1.0f, 4);
  ASSERT_GT(together.size(), kQueries / 4);
  for (const Match &m : together) {
    ASSERT_EQ(all(view_, {&queries_[m.query], 1}, 1.0f, 4).size(), 1u);
    EXPECT_EQ(matches_[0].point_index, m.point_index);
    EXPECT_EQ(matches_[0].second2, m.second2);
  }
}

TEST_F(IndexedMatcherTest, FewQueriesThenMoreIsAllAtOnce) {
  const auto at_once = all(view_, queries(), 0.9f, 8);
  matcher_.ask(view_, queries(), 8);
  matcher_.matchAll(17, 0.9f, room());
  matcher_.matchAll(90, 0.9f, room());
  EXPECT_TRUE(same(at_once, taken(matcher_.matchAll(kQueries, 0.9f, room()))));
}

TEST_F(IndexedMatcherTest, FewQueriesAfterAllAreThoseAlone) {
  const auto few = all(view_, {queries_.data(), 17}, 0.9f, 8);
  matcher_.ask(view_, queries(), 8);
  matcher_.matchAll(kQueries, 0.9f, room());
  EXPECT_TRUE(same(few, taken(matcher_.matchAll(17, 0.9f, room()))));
}

// Against the clock: time is the number of times it is read.
class MatcherDeadline : public IndexedMatcherTest {
 protected:
  Deadline after(int64_t looks) { return clock_.deadline(clock_.now_ns + looks); }
  // Of the queries that were answered, what they find without a deadline.
  void expectPartOf(const std::vector<Match> &whole, const std::vector<Match> &part) {
    uint32_t last = 0;
    for (const Match &m : part) {
      last = std::max(last, m.query);
      EXPECT_TRUE(std::any_of(whole.begin(), whole.end(), [&](const Match &other) { return same(m, other); }));
    }
    uint32_t before = 0;
    for (const Match &m : whole) before += m.query <= last;
    EXPECT_TRUE(part.empty() || part.size() == before);
  }

  test::SteppingClock clock_{1};
};

TEST_F(MatcherDeadline, QueriesAreAnsweredInFullOrNotAtAll) {
  constexpr uint64_t kTimed = 2;  // before and after, to learn the pace
  for (const uint32_t cells : {1u, 40u})
    for (const bool exact : {false, true}) {
      useCells(cells);
      const auto match = [&](const Deadline &deadline) {
        matcher_.ask(view_, queries(), 8);
        return taken(exact ? matcher_.matchExact(1, room(), deadline)
                           : matcher_.matchAll(kQueries, 1, room(), deadline));
      };
      const auto whole = match({});
      EXPECT_FALSE(matcher_.wasCut());
      size_t before = 0;
      bool cut = true;
      for (int64_t looks = 1; cut; ++looks) {
        const uint64_t reads = clock_.reads;
        const auto part = match(after(looks));
        cut = matcher_.wasCut();
        EXPECT_LE(clock_.reads, reads + static_cast<uint64_t>(looks) + kTimed) << "it went on";
        EXPECT_GE(part.size(), before);
        expectPartOf(whole, part);
        before = part.size();
        ASSERT_LT(looks, 1000);
      }
      EXPECT_EQ(before, whole.size());
    }
}

TEST_F(MatcherDeadline, GuidedMatchingToo) {
  const std::vector<Direction> expected = expectedDirections();
  useCells(1);
  const auto match = [&](const Deadline &deadline) {
    matcher_.ask(view_, queries(), 8);
    return taken(matcher_.matchNear({expected.data(), expected.size()}, -1, 1, room(), deadline));
  };
  const auto whole = match({});
  ASSERT_GT(whole.size(), kQueries / 2);
  bool cut = true;
  for (int64_t looks = 1; cut; ++looks) {
    const auto part = match(after(looks));
    expectPartOf(whole, part);
    cut = matcher_.wasCut();
    EXPECT_TRUE(cut || part.size() == whole.size()) << "it says that it answered all";
    ASSERT_LT(looks, 1000);
  }
}

// Of a map whose points all lie in one cell every query looks at all, and still the clock is read in time.
TEST_F(MatcherDeadline, BetweenTwoLooksLieFewComparisons) {
  for (int i = 0; i < 20000; ++i)
    points_.push_back({test::randomDirection(&random_), test::randomDescriptor(&random_)});
  useCells(1);
  constexpr uint64_t kMostComparisons = 64 * 128;
  for (const bool exact : {false, true}) {
    matcher_.ask(view_, queries(), 8);
    const uint64_t reads = clock_.reads;
    const Deadline distant = after(int64_t{1} << 40);
    exact ? matcher_.matchExact(1, room(), distant) : matcher_.matchAll(kQueries, 1, room(), distant);
    EXPECT_GE((clock_.reads - reads) * kMostComparisons, uint64_t{kQueries} * points_.size()) << exact;
  }
}

TEST_F(MatcherDeadline, WhatWasLeftOutIsFoundWhenThereIsTimeAgain) {
  const auto whole = all(view_, queries(), 0.9f, 8);
  matcher_.ask(view_, queries(), 8);
  matcher_.matchAll(kQueries, 0.9f, room(), after(2));
  EXPECT_TRUE(matcher_.wasCut());
  EXPECT_TRUE(same(whole, taken(matcher_.matchAll(kQueries, 0.9f, room()))));
  EXPECT_FALSE(matcher_.wasCut());
}

// Wherever the cut was, and whatever the cells of other queries were.
TEST_F(MatcherDeadline, WhatWasNotRankedBeforeTheCutIsRanked) {
  const auto whole = all(view_, queries(), 0.9f, 8);
  const std::vector<Descriptor> others(queries_.rbegin(), queries_.rend());
  bool cut = true;
  for (int64_t looks = 1; cut; ++looks) {
    matcher_.ask(view_, {others.data(), others.size()}, 8);
    matcher_.matchAll(kQueries, 0.9f, room());
    matcher_.ask(view_, queries(), 8);
    matcher_.matchAll(kQueries, 0.9f, room(), after(looks));
    cut = matcher_.wasCut();
    EXPECT_TRUE(same(whole, taken(matcher_.matchAll(kQueries, 0.9f, room())))) << looks;
    ASSERT_LT(looks, 1000);
  }
}

// Guided matching that a deadline cut, and then again with time: the cells of what was answered are ranked already.
TEST_F(MatcherDeadline, WhatWasRankedBeforeTheCutIsNotRankedAgain) {
  const std::vector<Direction> expected = expectedDirections();
  const Span<const Direction> directions(expected.data(), expected.size());
  const std::vector<Descriptor> others(queries_.rbegin(), queries_.rend());
  for (const uint32_t pieces : {1u, 3u}) {
    const Parallel parallel = test::backwards(pieces);
    Matcher matcher;
    const test::ArenaMemory memory(
        [&](Arena &arena, bool real) { Matcher::layout(kQueries, arena, real ? &matcher : nullptr, parallel); });
    matcher.setParallel(parallel);
    const auto match = [&](const Deadline &deadline) {
      return taken(matcher.matchNear(directions, 0.9f, 1, room(), deadline));
    };
    matcher.ask(view_, queries(), 8);
    const auto whole = match({});
    ASSERT_GT(whole.size(), kQueries / 2);
    matcher.ask(view_, queries(), 8);
    uint64_t before = clock_.reads;
    match(after(1 << 20));
    const uint64_t reads_anew = clock_.reads - before;
    bool cut = true;
    for (int64_t looks = 2; cut; ++looks) {
      matcher.ask(view_, {others.data(), others.size()}, 8);
      match({});  // the cells of others lie where those of these will
      matcher.ask(view_, queries(), 8);
      match(after(looks));
      cut = matcher.wasCut();
      before = clock_.reads;
      EXPECT_TRUE(same(whole, match(after(1 << 20)))) << pieces << " pieces, cut after " << looks << " looks";
      if (pieces == 1 && looks > 4) {
        EXPECT_LT(clock_.reads - before, reads_anew) << looks;
      }
      ASSERT_LT(looks, 1000);
    }
  }
}

// What is found out about a query for one call serves the others, in any order.
TEST_F(IndexedMatcherTest, CallsAboutTheSameQueriesDoNotDisturbEachOther) {
  const std::vector<Direction> expected = expectedDirections();
  const Span<const Direction> few(expected.data(), kQueries / 2);
  const auto part = all(view_, {queries_.data(), kQueries / 3}, 0.9f, 12), whole = all(view_, queries(), 0.9f, 12);
  matcher_.ask(view_, queries(), 12);
  const auto near = taken(matcher_.matchNear(few, 0.99f, 0.9f, room()));
  EXPECT_FALSE(near.empty());
  matcher_.ask(view_, queries(), 12);
  EXPECT_TRUE(same(part, taken(matcher_.matchAll(kQueries / 3, 0.9f, room()))));
  EXPECT_TRUE(same(near, taken(matcher_.matchNear(few, 0.99f, 0.9f, room()))));
  EXPECT_TRUE(same(whole, taken(matcher_.matchAll(kQueries, 0.9f, room()))));
}

// The neighbours are the same; only the test of the ratio is made again.
TEST_F(IndexedMatcherTest, AnotherRatioGivesWhatAskingAnewGives) {
  const auto loose = all(view_, queries(), 0.95f, 2), strict = all(view_, queries(), 0.3f, 2),
             exact = exactly(0.95f);
  ASSERT_GT(loose.size(), strict.size());
  ASSERT_FALSE(same(loose, exact)) << "so few probes miss something";
  matcher_.ask(view_, queries(), 2);
  EXPECT_TRUE(same(strict, taken(matcher_.matchAll(kQueries, 0.3f, room()))));
  EXPECT_TRUE(same(loose, taken(matcher_.matchAll(kQueries, 0.95f, room()))));
  EXPECT_TRUE(same(exact, taken(matcher_.matchExact(0.95f, room()))));
  EXPECT_TRUE(same(loose, taken(matcher_.matchAll(kQueries, 0.95f, room()))));
}

TEST_F(IndexedMatcherTest, GuidedIsExactInTheConeWhateverItsSectors) {
  useCells(8);
  std::vector<Direction> expected;
  queries_.clear();
  for (uint32_t i = 0; i < kMap; i += 5) {
    queries_.push_back(jittered(view_.descriptor(i), 10, &random_));
    const Direction d = view_.direction(i);
    expected.push_back({d.x, d.y, d.z});
  }
  for (const double degrees : {0.5, 6.0, 30.0, 90.0, 120.0, 179.0}) {
    const float cosine = static_cast<float>(std::cos(degrees * kPi / 180));
    matcher_.ask(view_, queries(), 8);
    const auto matches = taken(matcher_.matchNear({expected.data(), expected.size()}, cosine, 1.0f, room()));
    EXPECT_EQ(matches.size(), queries_.size());
    for (const Match &m : matches) {
      NearestTwo two = {300 * 300, 300 * 300, UINT32_MAX};
      for (uint32_t i = 0; i < kMap; ++i) {
        const Direction d = view_.direction(i), e = expected[m.query];
        if (d.x * e.x + d.y * e.y + d.z * e.z > cosine)
          two.see(distance2Scalar(view_.descriptor(i), queries_[m.query]), i);
      }
      ASSERT_TRUE(same(m, {m.query, two.best_index, two.best2, two.second2})) << degrees;
    }
  }
}

}  // namespace
}  // namespace sphc
