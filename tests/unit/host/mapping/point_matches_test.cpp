#include "host/mapping/point_matches.h"

#include <gtest/gtest.h>

#include "made_up_walk.h"

namespace sphc::host {
namespace {

class PointMatchesTest : public testing::Test {
 protected:
  // Do both keypoints show one point of the room?
  bool isRight(const PointMatch &match) const {
    const SeenPoint &a = frames_[0].points[match.a], &b = frames_[1].points[match.b];
    return (made_.world_from_camera[0] * a.point_m() - made_.world_from_camera[1] * b.point_m()).norm() < 1e-9;
  }
  MadeUpWalk made_ = makeWalk({});
  std::vector<WalkFrame> &frames_ = made_.walk.keyframes;
};

TEST_F(PointMatchesTest, WhatBothFramesShowIsFound) {
  const std::vector<PointMatch> matches = matchAll(frames_[0], frames_[1]);
  EXPECT_GT(matches.size(), 100u);
  for (const PointMatch &match : matches) EXPECT_TRUE(isRight(match));
}

TEST_F(PointMatchesTest, TheSameIsFoundWhereAPoseExpectsIt) {
  const Rigid off = {rotationFromVector(Vector3(0.01, -0.02, 0.01)), Vector3(0.01, 0.02, -0.03)};
  const std::vector<PointMatch> matches = matchNear(frames_[0], frames_[1], off * stepOf(made_, {0, 1}));
  EXPECT_GT(matches.size(), 100u);
  for (const PointMatch &match : matches) EXPECT_TRUE(isRight(match));
}

TEST_F(PointMatchesTest, NothingIsFoundWhereAWrongPoseExpectsIt) {
  const Rigid off = {rotationFromVector(Vector3(0, 0.3, 0)), Vector3::Zero()};
  for (const PointMatch &match : matchNear(frames_[0], frames_[1], off * stepOf(made_, {0, 1})))
    EXPECT_FALSE(isRight(match));
}

// A thing that is there twice tells nothing.
TEST_F(PointMatchesTest, TwoThatLookTheSameAreNotMatched) {
  frames_[1].descriptors[7] = frames_[1].descriptors[8] = frames_[0].descriptors[3];
  const std::vector<PointMatch> matches = matchAll(frames_[0], frames_[1]);
  ASSERT_FALSE(matches.empty());
  for (const PointMatch &match : matches) EXPECT_NE(match.a, 3u);
}

// Of two that look much the same, the nearer one is matched, and it alone.
TEST_F(PointMatchesTest, MatchesAreNearestBothWays) {
  const PointMatch first = matchAll(frames_[0], frames_[1]).front();
  const uint32_t other = first.a + 1;
  frames_[0].descriptors[other] = frames_[0].descriptors[first.a];
  frames_[0].descriptors[other].bytes[0] ^= 64;
  bool is_still_there = false;
  for (const PointMatch &match : matchAll(frames_[0], frames_[1])) {
    EXPECT_NE(match.a, other);
    is_still_there = is_still_there || (match.a == first.a && match.b == first.b);
  }
  EXPECT_TRUE(is_still_there);
}

TEST_F(PointMatchesTest, AFrameWithoutKeypointsHasNoMatches) {
  EXPECT_TRUE(matchAll(frames_[0], WalkFrame()).empty());
  EXPECT_TRUE(matchAll(WalkFrame(), frames_[0]).empty());
  EXPECT_TRUE(matchNear(frames_[0], WalkFrame(), Rigid()).empty());
}

}  // namespace
}  // namespace sphc::host
