#include "host/mapping/likely_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "made_up_walk.h"

namespace sphc::host {
namespace {

FramePoses truthOf(const MadeUpWalk &made) {
  return {made.world_from_camera.begin(), made.world_from_camera.end()};
}

// Of a walk of two turns frame i shows what frame i + 30 does.
const MadeUpWalk &twoTurns() {
  static const MadeUpWalk made = makeWalk({60, 2, 1});
  return made;
}

bool holds(const std::vector<FramePair> &pairs, uint32_t a, uint32_t b) {
  return std::any_of(pairs.begin(), pairs.end(), [&](const FramePair &p) { return p.a == a && p.b == b; });
}

// Of frames 0 to 29, how many have a partner one turn later, or a frame beside it?
int withPartner(const std::vector<FramePair> &pairs) {
  int found = 0;
  for (uint32_t i = 0; i < 30; ++i) {
    bool has = false;
    for (uint32_t j = std::max(29u, i + 28); j <= std::min(59u, i + 32); ++j) has = has || holds(pairs, i, j);
    found += has;
  }
  return found;
}

TEST(LikelyPairsTest, NeighboursInTimeOverGrowingGaps) {
  const std::vector<FramePair> pairs = pairsInTime(std::vector<WalkFrame>(20));
  EXPECT_TRUE(holds(pairs, 18, 19));
  EXPECT_TRUE(holds(pairs, 2, 19));
  EXPECT_FALSE(holds(pairs, 0, 19)) << "19 apart";
  EXPECT_TRUE(pairsInTime(std::vector<WalkFrame>(1)).empty());
}

TEST(LikelyPairsTest, FramesOfTwoRecordingsAreNoNeighboursButLoops) {
  std::vector<WalkFrame> frames(20);
  for (uint32_t i = 10; i < 20; ++i) frames[i].recording = 1;
  const std::vector<FramePair> pairs = pairsInTime(frames);
  EXPECT_TRUE(holds(pairs, 8, 9));
  EXPECT_TRUE(holds(pairs, 10, 11));
  EXPECT_FALSE(holds(pairs, 9, 10));
  EXPECT_TRUE(isLoop(frames, {9, 10}));
  EXPECT_FALSE(isLoop(frames, {10, 11}));
}

// The second recording shows nothing that the end of the first does not, one frame later.
TEST(LikelyPairsTest, AFrameHasPartnersInOtherRecordings) {
  MadeUpWalk made = twoTurns();
  for (uint32_t i = 30; i < 60; ++i) made.walk.keyframes[i].recording = 1;
  for (const auto &pairs :
       {pairsByLook(made.walk.keyframes), pairsByOverlap(made.walk.keyframes, truthOf(made), {})})
    EXPECT_TRUE(holds(pairs, 29, 30) || holds(pairs, 29, 31) || holds(pairs, 28, 30)) << "beside each other";
}

TEST(LikelyPairsTest, LoopsAreFoundByTheirLook) {
  const std::vector<FramePair> pairs = pairsByLook(twoTurns().walk.keyframes);
  EXPECT_GE(withPartner(pairs), 28);
  for (const FramePair &pair : pairs) EXPECT_GT(pair.gap(), kMostGapInTime);
}

TEST(LikelyPairsTest, FramesOfHardlyAKeypointArePairsAllTheSame) {
  for (size_t keypoints = 0; keypoints <= 4; ++keypoints) {
    std::vector<WalkFrame> frames(2 * kMostGapInTime);
    for (size_t i = 0; i < keypoints; ++i) frames[i].descriptors.resize(1);
    EXPECT_FALSE(pairsByLook(frames).empty()) << keypoints;
  }
}

TEST(LikelyPairsTest, FramesOfOneSurfaceOverlap) {
  const MadeUpWalk &made = twoTurns();
  const std::vector<FramePair> pairs = pairsByOverlap(made.walk.keyframes, truthOf(made), {});
  EXPECT_GE(withPartner(pairs), 28);
  EXPECT_FALSE(holds(pairs, 0, 15)) << "the other wall";
}

TEST(LikelyPairsTest, WhatWasTriedOrHasNoPoseIsNotOffered) {
  const MadeUpWalk &made = twoTurns();
  FramePoses poses = truthOf(made);
  poses[3].reset();
  const std::vector<FramePair> all = pairsByOverlap(made.walk.keyframes, truthOf(made), {});
  const std::set<FramePair> tried(all.begin(), all.end());
  const auto isOfThree = [](const FramePair &pair) { return pair.a == 3 || pair.b == 3; };
  EXPECT_TRUE(std::any_of(all.begin(), all.end(), isOfThree));
  const std::vector<FramePair> more = pairsByOverlap(made.walk.keyframes, poses, tried);
  ASSERT_FALSE(more.empty());
  for (const FramePair &pair : more) {
    EXPECT_FALSE(tried.count(pair));
    EXPECT_FALSE(isOfThree(pair));
  }
}

}  // namespace
}  // namespace sphc::host
