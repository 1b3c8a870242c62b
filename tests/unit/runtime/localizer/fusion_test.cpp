#include "runtime/localizer/fusion.h"

#include <gtest/gtest.h>

#include "runtime/stages/pose/confidence.h"
#include "tests/unit/runtime/localizer/room_parts.h"

namespace sphc {
namespace {

constexpr int64_t kOdometryStepNs = 33000000;

MapOrder orderOf(std::initializer_list<uint32_t> maps) {
  MapOrder order;
  for (uint32_t map : maps) order.push(map);
  return order;
}

class FusionTest : public testing::Test {
 protected:
  void SetUp() override { parts_.see(0); }
  // This frame's matches: keypoints and their map points.
  const MatchSet &matches(std::initializer_list<std::pair<uint32_t, uint32_t>> found) {
    MatchSet &matched = parts_.found.matched;
    uint32_t count = 0;
    for (const auto &[query, point] : found) matched.room()[count++] = {query, point, 10, 40};
    matched.assign(count, parts_.front, parts_.search.map(0));
    return matched;
  }
  // The next frame, the camera having moved so far along x by odometry.
  void advance(double x_m) {
    const Odometry odometry = {{Matrix3::Identity(), Vector3(x_m_ += x_m, 0, 0)}, 1e-4, 1e-4};
    tracker_.advance(time_ns_ += kOdometryStepNs, &odometry);
    parts_.fusion.advance(tracker_);
  }
  // Of what is kept, behind `own`.
  Span<const Correspondence> added(const MatchSet &own) {
    parts_.fusion.addTo(parts_.search.map(0), &parts_.found.matched);
    return {own.all().begin() + own.matches().size(), own.all().size() - own.matches().size()};
  }

  test::RoomParts parts_;
  Tracker tracker_;
  int64_t time_ns_ = 0;
  double x_m_ = 0;
};

TEST_F(FusionTest, OneFrameAloneHasNoOthers) {
  EXPECT_FALSE(parts_.fusion.remember(0, matches({{0, 10}, {1, 11}})));
  EXPECT_EQ(parts_.fusion.frames(), 1u);
}

TEST_F(FusionTest, EarlierMatchesMoveAlongAndJoin) {
  advance(0);
  parts_.fusion.remember(0, matches({{0, 10}}));
  const Vector3 before = parts_.front.lifted()[0].point_m;
  advance(0.1);
  const MatchSet &now = matches({{1, 11}});
  EXPECT_TRUE(parts_.fusion.remember(0, now));
  EXPECT_EQ(parts_.fusion.frames(), 2u);
  const auto earlier = added(now);
  ASSERT_EQ(earlier.size(), 1u);
  EXPECT_LT((earlier[0].lifted.point_m - (before - Vector3(0.1, 0, 0))).norm(), 1e-9);
  EXPECT_EQ(earlier[0].direction, directionOf(parts_.search.map(0), 10));
}

// The same wrong match, seen twice, is no evidence.
TEST_F(FusionTest, AMapPointThisFrameMatchedJoinsNotAgain) {
  advance(0);
  parts_.fusion.remember(0, matches({{0, 10}, {1, 11}}));
  advance(0.1);
  const auto earlier = added(matches({{3, 10}}));
  ASSERT_EQ(earlier.size(), 1u);
  EXPECT_EQ(earlier[0].direction, directionOf(parts_.search.map(0), 11));
}

TEST_F(FusionTest, WhatThisFrameRemembersJoinsOnlyWhereItHasNoMatchesNow) {
  advance(0);
  parts_.fusion.remember(0, matches({{0, 10}, {1, 11}}));
  EXPECT_EQ(added(matches({{2, 12}})).size(), 0u);  // it speaks for itself
  EXPECT_EQ(added(matches({})).size(), 2u);
}

TEST_F(FusionTest, WithoutOdometryAllIsForgotten) {
  advance(0);
  parts_.fusion.remember(0, matches({{0, 10}}));
  tracker_.advance(time_ns_ += kOdometryStepNs, nullptr);
  parts_.fusion.advance(tracker_);
  EXPECT_EQ(parts_.fusion.frames(), 0u);
  EXPECT_FALSE(parts_.fusion.remember(0, matches({{1, 11}})));
}

// By as much as its inliers are theirs.
TEST_F(FusionTest, APoseOfEarlierMatchesIsOffByTheirDrift) {
  advance(0);
  parts_.fusion.remember(0, matches({{0, 10}}));
  advance(0.1);
  parts_.fusion.remember(0, matches({{1, 11}}));
  Estimate estimate;
  estimate.inliers = 100;
  estimate.covariance = 1e-8 * Matrix6::Identity();
  const Matrix6 before = statedCovariance(estimate);
  parts_.fusion.widenByDrift(0.5, &estimate);
  const Matrix6 wider = statedCovariance(estimate) - before;
  for (int axis = 0; axis < 6; ++axis)
    EXPECT_NEAR(wider(axis, axis), 0.25e-8, 1e-14) << axis;  // of 0.1 mrad, 0.1 mm
}

TEST_F(FusionTest, RaysAreNotRemembered) {
  const uint32_t ray = parts_.front.liftedCount();
  ASSERT_LT(ray, parts_.front.keypointCount()) << "the frame has no keypoint without depth";
  parts_.fusion.remember(0, matches({{ray, 10}}));
  EXPECT_EQ(parts_.fusion.frames(), 0u);
}

TEST_F(FusionTest, OneMapAtATime) {
  EXPECT_EQ(parts_.fusion.mapToRemember(orderOf({2, 0})), 2u);  // nothing is kept: the likeliest
  advance(0);
  parts_.fusion.remember(5, matches({{0, 10}}));
  EXPECT_EQ(parts_.fusion.mapToRemember(orderOf({2, 5})), 5u);  // as long as it is likely
  EXPECT_EQ(parts_.fusion.mapToRemember(orderOf({2, 3})), 2u);
  advance(0);
  EXPECT_FALSE(parts_.fusion.remember(2, matches({{1, 11}})));  // of another map: those of before are gone
  EXPECT_EQ(parts_.fusion.frames(), 1u);
  EXPECT_EQ(parts_.fusion.mapToRemember(orderOf({2, 5})), 2u);
}

TEST_F(FusionTest, ClearedItHoldsNothing) {
  parts_.fusion.remember(0, matches({{0, 10}}));
  parts_.fusion.clear();
  EXPECT_EQ(parts_.fusion.frames(), 0u);
  EXPECT_EQ(added(matches({})).size(), 0u);
}

}  // namespace
}  // namespace sphc
