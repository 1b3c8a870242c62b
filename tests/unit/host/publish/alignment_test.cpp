#include "host/publish/alignment.h"

#include <gtest/gtest.h>

#include "tests/support/made_up_model.h"

namespace sphc::host {
namespace {

Similarity turned(double scale) {
  Random random(4);
  return {scale, test::randomRotation(&random), Vector3(3, -1, 2)};
}

// Pairs that agree with the similarity, and pairs that lie anywhere.
std::vector<PointPair> pairsOf(const Similarity &place_from_model, int agreeing, int others, uint64_t seed = 1) {
  Random random(seed);
  std::vector<PointPair> pairs;
  for (int i = 0; i < agreeing + others; ++i) {
    const Vector3 model_m = 1.5 * test::normalVector(&random), anywhere_m = 3 * test::normalVector(&random);
    const Vector3 noise_m = 0.01 * test::normalVector(&random);
    pairs.push_back({model_m, i < agreeing ? place_from_model * model_m + noise_m : anywhere_m, 0.005});
  }
  return pairs;
}

void expectSame(const Similarity &found, const Similarity &truth) {
  EXPECT_NEAR(found.scale, truth.scale, 0.01);
  EXPECT_LT(rotationAngle(found.rotation.transpose() * truth.rotation), 0.01);
  EXPECT_LT((found.translation_m - truth.translation_m).norm(), 0.02);
}

TEST(Alignment, FindsTheFrameAmongWrongPairs) {
  for (const double scale : {1.0, 0.9, 1.1}) {
    const auto found = alignments(pairsOf(turned(scale), 60, 140));
    ASSERT_EQ(found.size(), 1u) << scale;
    expectSame(found[0], turned(scale));
  }
}

TEST(Alignment, WhatWasMovedIsASecondOne) {
  const Similarity room = turned(1);
  const Similarity moved = {1, rotationFromVector(Vector3(0, 0.5, 0)) * room.rotation, Vector3(0, 2, 0)};
  std::vector<PointPair> pairs = pairsOf(room, 80, 50);
  for (const PointPair &pair : pairsOf(moved, 40, 0, 2)) pairs.push_back(pair);
  const auto found = alignments(pairs);
  ASSERT_EQ(found.size(), 2u);
  expectSame(found[0], room);  // the larger support first
  expectSame(found[1], moved);
}

TEST(Alignment, AFewPairsOrAnotherScaleAreNone) {
  EXPECT_TRUE(alignments(pairsOf(turned(1), 10, 100)).empty());
  EXPECT_TRUE(alignments(pairsOf(turned(1.6), 100, 0)).empty());
  EXPECT_TRUE(alignments({}).empty());
}

TEST(Alignment, AnotherScaleIsTold) {
  for (const double scale : {0.2, 1.6, 40.0})
    EXPECT_NEAR(otherScale(pairsOf(turned(scale), 100, 80)) / scale, 1, 0.15) << scale;
  for (const double scale : {0.9, 1.0, 1.1}) EXPECT_EQ(otherScale(pairsOf(turned(scale), 100, 80)), 1) << scale;
  EXPECT_EQ(otherScale({}), 1);
}

TEST(Alignment, PairsAreOfPointsThatLookAlikeAndNoOthers) {
  const PointModel room = test::madeUpRoom(200, 5), other = test::madeUpRoom(200, 6);
  const PointModel again = test::seenAgain(room, 7);
  const auto pairs = pairByDescriptor(room.points, again.points, 50);
  EXPECT_GT(pairs.size(), 40u);
  EXPECT_LE(pairs.size(), 50u);  // as many as were asked for
  for (const PointPair &pair : pairs) EXPECT_LT((pair.model_m - pair.place_m).norm(), 0.2);
  EXPECT_LT(pairByDescriptor(room.points, other.points, 200).size(), 20u);
}

}  // namespace
}  // namespace sphc::host
