#include "host/mapping/frame_links.h"

#include <gtest/gtest.h>

#include "made_up_walk.h"

namespace sphc::host {
namespace {

constexpr uint32_t kMostKeypoints = 1500;

// Error of the link in its own sigmas, squared: six degrees of freedom.
double squaredSigmas(const MadeUpWalk &made, const FrameLink &link) {
  const Rigid off = stepOf(made, link.frames) * link.b_from_a.inverse();
  Vector6 xi;
  xi << vectorFromRotation(off.rotation), off.translation_m;
  return xi.dot(link.covariance.inverse() * xi);
}

TEST(FrameLinksTest, TheStepBetweenTwoFramesIsFoundToItsSigmas) {
  const MadeUpWalk made = makeWalk({40, 1, 1});
  FrameLinker linker(kMostKeypoints);
  for (uint32_t a = 0; a < 10; ++a) {
    const auto link = linker.link(made.walk.keyframes, {a, a + 2}, {});
    ASSERT_TRUE(link);
    EXPECT_LT(squaredSigmas(made, *link), 30) << a;  // beyond it: one in 25 000
    EXPECT_GT(link->matches.size(), 60u);
  }
}

TEST(FrameLinksTest, AnExpectedStepIsConfirmed) {
  const MadeUpWalk made = makeWalk({40, 1, 1});
  FrameLinker linker(kMostKeypoints);
  const Rigid expected =
      Rigid{rotationFromVector(Vector3(0.02, 0, 0.01)), Vector3(0.03, 0, 0.02)} * stepOf(made, {3, 5});
  const auto link = linker.link(made.walk.keyframes, {3, 5}, {}, &expected);
  ASSERT_TRUE(link);
  EXPECT_LT(squaredSigmas(made, *link), 30);
}

TEST(FrameLinksTest, FramesOfTwoRoomsHaveNoLink) {
  const MadeUpWalk made = joined(makeWalk({10, 0.25, 1}), makeWalk({10, 0.25, 1, 0, 0, 2}));
  FrameLinker linker(kMostKeypoints);
  for (uint32_t i = 0; i < 10; ++i) EXPECT_FALSE(linker.link(made.walk.keyframes, {i, 10 + i}, {}));
}

// Depth of one frame that is not that of its image: its own direction may agree, the other does not.
TEST(FrameLinksTest, DepthOfAnotherSceneMakesNoLink) {
  MadeUpWalk made = makeWalk({40, 1, 1});
  std::vector<SeenPoint> &points = made.walk.keyframes[1].points;
  for (size_t i = 0; i < points.size(); ++i) points[i].depth_m = 1 + 0.37 * static_cast<double>(i % 7);
  EXPECT_FALSE(FrameLinker(kMostKeypoints).link(made.walk.keyframes, {0, 1}, {}));
}

// Each direction finds a pose, a fifth longer by one than by the other.
TEST(FrameLinksTest, DepthsOfTwoScalesMakeNoLink) {
  MadeUpWalk made = makeWalk({40, 1, 0.2});
  EXPECT_TRUE(FrameLinker(kMostKeypoints).link(made.walk.keyframes, {0, 4}, {}));
  for (SeenPoint &point : made.walk.keyframes[4].points) point.depth_m *= 1.25;
  EXPECT_FALSE(FrameLinker(kMostKeypoints).link(made.walk.keyframes, {0, 4}, {}));
}

TEST(FrameLinksTest, FewInliersAreNoLink) {
  const MadeUpWalk made = makeWalk({40, 1, 1});
  LinkDemands many;
  many.min_inliers = 1000;
  EXPECT_FALSE(FrameLinker(kMostKeypoints).link(made.walk.keyframes, {0, 1}, many));
}

}  // namespace
}  // namespace sphc::host
