#include "host/mapping/pair_linker.h"

#include <gtest/gtest.h>

#include "made_up_walk.h"

namespace sphc::host {
namespace {

constexpr uint32_t kMostKeypointsOfPairs = 1500;

// Neighbours, and pairs with nothing in common.
std::vector<FramePair> somePairs() {
  std::vector<FramePair> pairs;
  for (uint32_t a = 0; a < 18; ++a) pairs.push_back({a, a + 2});
  pairs.push_back({0, 20});
  pairs.push_back({5, 25});
  return pairs;
}

TEST(PairLinkerTest, EveryNumberOfThreadsGivesTheLinksOfOneLinker) {
  const MadeUpWalk made = makeWalk({40, 1, 1});
  const std::vector<FramePair> pairs = somePairs();
  FrameLinker one(kMostKeypointsOfPairs);
  for (uint32_t threads : {1u, 2u, 3u, 0u}) {
    PairLinker linker(kMostKeypointsOfPairs, threads);
    const auto links = linker.link(made.walk.keyframes, pairs, {}, nullptr);
    ASSERT_EQ(links.size(), pairs.size());
    for (size_t i = 0; i < pairs.size(); ++i) {
      const auto expected = one.link(made.walk.keyframes, pairs[i], {});
      ASSERT_EQ(links[i].has_value(), expected.has_value()) << i;
      if (!expected) continue;
      EXPECT_EQ(links[i]->frames.a, pairs[i].a);
      EXPECT_EQ(links[i]->b_from_a.rotation, expected->b_from_a.rotation);
      EXPECT_EQ(links[i]->b_from_a.translation_m, expected->b_from_a.translation_m);
      EXPECT_EQ(links[i]->matches.size(), expected->matches.size());
    }
    EXPECT_TRUE(links[0]);
    EXPECT_FALSE(links[18]);
  }
}

// Where a pose is expected, a link is looked for there and not elsewhere.
TEST(PairLinkerTest, LinksAreLookedForWhereTheyAreExpected) {
  const MadeUpWalk made = makeWalk({40, 1, 1});
  FramePoses right(made.world_from_camera.begin(), made.world_from_camera.end()), wrong = right;
  for (size_t i = 0; i < wrong.size(); i += 2) wrong[i]->translation_m += Vector3(0, 0, 3);
  PairLinker linker(kMostKeypointsOfPairs, 2);
  const std::vector<FramePair> pairs = {{0, 1}, {2, 3}, {4, 5}};
  const auto found = linker.link(made.walk.keyframes, pairs, {}, &right),
             none = linker.link(made.walk.keyframes, pairs, {}, &wrong);
  ASSERT_EQ(found.size(), pairs.size());
  ASSERT_EQ(none.size(), pairs.size());
  for (const auto &link : found) EXPECT_TRUE(link);
  for (const auto &link : none) EXPECT_FALSE(link);
}

}  // namespace
}  // namespace sphc::host
