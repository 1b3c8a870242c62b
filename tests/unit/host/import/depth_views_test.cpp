#include "host/import/depth_views.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/host/import/room_with_things.h"

namespace sphc::host {
namespace {

constexpr double kMinM = 0.3, kMaxM = 6;
const Rigid kAtOrigin = standing(Vector3::Zero(), 0);
const Box kPillar = {{-0.3, -1.1, 2}, {0.3, 1.5, 2.4}};

// What a view of the room, or of the room with a pillar, says of a point.
Sight sightOf(const std::vector<Box> &things, const Vector3 &point_m) {
  DepthViews views(depthRig(), kMinM, kMaxM);
  views.add(RoomView(kAtOrigin, things).image(), kAtOrigin);
  Sight sight = {};
  EXPECT_TRUE(views.look(0, point_m, &sight));
  return sight;
}

TEST(DepthViews, APointOnASurfaceIsNotOff) {
  const Sight sight = sightOf({kPillar}, {0, 0, 2});
  EXPECT_EQ(sight.depth_m, 2);
  EXPECT_LT(sight.off_m, 0.002);
  EXPECT_LT(sight.beyond_m, 0.002);
}

TEST(DepthViews, WhatIsFartherIsBeyondThePoint) { EXPECT_NEAR(sightOf({}, {0, 0, 2}).beyond_m, 2, 0.002); }

TEST(DepthViews, WhatIsNearerIsNotBeyondThePoint) {
  const Sight sight = sightOf({kPillar}, {0, 0, 3});
  EXPECT_NEAR(sight.beyond_m, -1, 0.002);
  EXPECT_NEAR(sight.off_m, 1, 0.002);
}

// A pixel from the pillar's edge, on either side.
TEST(DepthViews, AtAnEdgeNotEverythingAroundAPointIsBeyondIt) {
  for (double x : {-0.31, -0.29}) {
    EXPECT_LT(sightOf({kPillar}, {x, 0, 2}).beyond_m, 0.002);
    EXPECT_LT(sightOf({kPillar}, {x, 0, 2}).off_m, 0.002);
  }
}

TEST(DepthViews, OutsideOfTheViewNothingIsSeen) {
  DepthViews views(depthRig(), kMinM, kMaxM);
  views.add(RoomView(kAtOrigin, {}).image(), kAtOrigin);
  Sight sight;
  EXPECT_FALSE(views.look(0, {0, 0, -2}, &sight));
  EXPECT_FALSE(views.look(0, {3, 0, 1}, &sight));
  EXPECT_FALSE(views.look(0, {0, 0, 0}, &sight));
}

TEST(DepthViews, WhereDepthIsMissingNothingIsBeyond) {
  RoomView view(kAtOrigin, {});
  DepthViews views(depthRig(), kMinM, kMaxM);
  for (uint16_t unmeasured : {uint16_t{0}, uint16_t{100}, uint16_t{65535}}) {
    std::fill(view.depth_mm.begin(), view.depth_mm.end(), unmeasured);
    views.add(view.image(), kAtOrigin);
    Sight sight;
    ASSERT_TRUE(views.look(views.count() - 1, {0, 0, 2}, &sight));
    EXPECT_LT(sight.beyond_m, 0) << unmeasured;
    EXPECT_TRUE(std::isinf(sight.off_m)) << unmeasured;
  }
}

TEST(DepthViews, OfManyFramesEvenlyChosenOnesAreKept) {
  const RoomView view(kAtOrigin, {});
  DepthViews views(depthRig(), kMinM, kMaxM);
  constexpr int kFrames = 900;
  for (int i = 0; i < kFrames; ++i) views.add(view.image(), standing(Vector3(0.001 * i, 0, 0), 0));
  EXPECT_LE(views.count(), DepthViews::kMost);
  EXPECT_GE(views.count(), DepthViews::kMost / 2);
  for (size_t k = 0; k < views.count(); ++k) {
    const Vector3 camera_m = views.camera_m(k);
    EXPECT_NEAR(camera_m.x(), 0.004 * static_cast<double>(k), 1e-9);
    Sight sight = {};
    ASSERT_TRUE(views.look(k, camera_m + Vector3(0, 0, 2), &sight));
    EXPECT_NEAR(sight.beyond_m, 2, 0.002) << k;  // the same image each
  }
}

}  // namespace
}  // namespace sphc::host
