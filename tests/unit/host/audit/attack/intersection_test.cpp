#include "host/audit/attack/intersection.h"

#include <gtest/gtest.h>

#include "host/audit/score/release_scores.h"
#include "tests/unit/host/audit/made_up_releases.h"

namespace sphc::host {
namespace {

constexpr double kThirdReal = 1.0 / 3;

struct Result {
  double precision, exposed;
};

Result attack(const std::vector<test::MadeUpRelease> &releases) {
  std::vector<Published> maps;
  std::vector<std::vector<EntryTruth>> truths;
  for (const test::MadeUpRelease &release : releases) {
    maps.push_back(release.map);
    truths.push_back(release.truth);
  }
  const auto believed = intersectReleases(maps, {});
  return {
      scoreEntries(believed.back(), truths.back()).precision(),
      static_cast<double>(distinctReal(believed, maps, truths)) / static_cast<double>(maps.back().packed.size())};
}

// Fresh assignments about one centre: after k releases most points are known.
TEST(Intersection, CarelessRebuildsExposeThePoints) {
  const PointModel room = test::madeUpRoom(2000, 1);
  const double expected[] = {0, 0, 0.111, 0.259, 0.407, 0.539, 0.649, 0.737, 0.805};
  std::vector<test::MadeUpRelease> releases;
  for (uint8_t key = 1; key <= 8; ++key) {
    releases.push_back(test::released(room, key, kThirdReal));
    if (key < 2) continue;
    const Result result = attack(releases);
    EXPECT_GT(result.precision, 0.99) << int{key};
    EXPECT_NEAR(result.exposed, expected[key], 0.03) << int{key};
  }
}

TEST(Intersection, ReleasesOfOneLedgerSayNoMoreThanTheLast) {
  const PointModel room = test::madeUpRoom(2000, 1);
  std::vector<test::MadeUpRelease> releases = {test::released(room, 1, kThirdReal)};
  for (uint64_t seed = 2; seed < 5; ++seed) {
    const PointModel more = test::seenLater(room, 2000, test::madeUpRoom(200, seed), seed);
    releases.push_back(test::released(more, 1, kThirdReal, {releases.back().place}));
  }
  ASSERT_EQ(releases.back().place.releases.size(), 4u);
  EXPECT_NEAR(attack(releases).precision, kThirdReal, 0.005);
  // And what is new in the last says as little.
  Exposure fresh;
  for (const EntryTruth &entry : releases.back().truth)
    if (entry.release == 4) ++fresh.believed, fresh.real += entry.real;
  EXPECT_EQ(fresh.believed, 200u);
  EXPECT_NEAR(fresh.precision(), kThirdReal, 0.005);
}

}  // namespace
}  // namespace sphc::host
