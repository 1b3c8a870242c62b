#include "host/mapping/pose_graph.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "made_up_walk.h"

namespace sphc::host {
namespace {

using Parts = std::vector<uint32_t>;

FrameLink bare(uint32_t a, uint32_t b, uint32_t inliers = 30) {
  FrameLink link;
  link.frames = {a, b};
  link.inliers = inliers;
  link.is_loop = b - a > kMostGapInTime;
  return link;
}

// Two frames beside each other are far apart in time where they are of two recordings.
TEST(PoseGraphTest, OneLoopBetweenRecordingsConnectsNothing) {
  std::vector<FrameLink> links = {bare(0, 1), bare(1, 2), bare(2, 3)};
  links[1].is_loop = true;
  EXPECT_EQ(dropWeakBridges(4, &links), 1u);
}

TEST(PoseGraphTest, PartsAreNumberedByTheirSize) {
  EXPECT_EQ(connectedParts(6, {bare(0, 1), bare(2, 3), bare(3, 5)}), (Parts{1, 1, 0, 0, 2, 0}));
  EXPECT_EQ(connectedParts(2, std::vector<FrameLink>()), (Parts{0, 1}));
}

TEST(PoseGraphTest, OneLoopAloneConnectsNothing) {
  std::vector<FrameLink> links = {bare(0, 1), bare(1, 2), bare(30, 31), bare(31, 32), bare(0, 30)};
  EXPECT_EQ(dropWeakBridges(40, &links), 1u);
  EXPECT_EQ(connectedParts(40, links)[0] == connectedParts(40, links)[30], false);
}

TEST(PoseGraphTest, ThreeLoopsOrOneThatIsSureConnect) {
  std::vector<FrameLink> three = {bare(0, 1),  bare(1, 2),  bare(30, 31), bare(31, 32),
                                  bare(0, 30), bare(1, 31), bare(2, 32)};
  EXPECT_EQ(dropWeakBridges(40, &three), 0u);
  std::vector<FrameLink> sure = {bare(0, 1), bare(30, 31), bare(0, 30, 100)};
  EXPECT_EQ(dropWeakBridges(40, &sure), 0u);
}

class LoopTest : public testing::Test {
 protected:
  LoopTest() {
    for (uint32_t i = 0; i + 1 < 40; ++i) links_.push_back(exactLink(made_, {i, i + 1}, 100));
    for (uint32_t i = 0; i + 3 < 40; ++i) links_.push_back(exactLink(made_, {i, i + 3}, 60));
    for (uint32_t i = 0; i < 5; ++i) links_.push_back(exactLink(made_, {i, i + 35}, 50));
  }
  FramePoses chain() const { return posesAlongLinks(links_, connectedParts(40, links_), none_); }
  FramePoses solve() const {
    FramePoses poses = chain();
    adjustToLinks(links_, none_, &poses);
    return poses;
  }
  double worstOffM(const FramePoses &poses) const {
    double worst = 0;
    for (size_t i = 0; i < poses.size(); ++i) {
      const Rigid truth = made_.world_from_camera[0].inverse() * made_.world_from_camera[i];
      worst = std::max(worst, (truth.translation_m - poses[i]->translation_m).norm());
    }
    return worst;
  }
  MadeUpWalk made_ = makeWalk({});
  PoseBeliefs none_{made_.walk.keyframes, {}};
  std::vector<FrameLink> links_;
};

TEST_F(LoopTest, ExactLinksGiveThePoses) {
  const FramePoses poses = solve();
  EXPECT_LT(worstOffM(poses), 1e-6);
  for (const FrameLink &link : links_) EXPECT_TRUE(isConsistent(link, poses));
}

TEST_F(LoopTest, StepsThatAreABitLongAreSpreadOverTheLoop) {
  for (size_t i = 0; i < 39; ++i) links_[i].b_from_a.translation_m *= 1.02;
  const FramePoses chained = chain();
  EXPECT_LT(worstOffM(solve()), 0.5 * worstOffM(chained));
}

TEST_F(LoopTest, AFalseLinkIsContradicted) {
  links_.push_back(exactLink(made_, {4, 24}, 55));
  links_.back().b_from_a =
      Rigid{rotationFromVector(Vector3(0, 0.5, 0)), Vector3(0.4, 0, 0)} * links_.back().b_from_a;
  const FramePoses poses = solve();
  EXPECT_LT(worstOffM(poses), 0.01);
  EXPECT_FALSE(isConsistent(links_.back(), poses));
  EXPECT_TRUE(isConsistent(links_.front(), poses));
}

// Of the truth, with the second half moved away from it: no link says where that is.
class BeliefsTest : public LoopTest {
 protected:
  BeliefsTest() {
    const auto crosses = [](const FrameLink &link) { return link.frames.a < 20 && link.frames.b >= 20; };
    links_.erase(std::remove_if(links_.begin(), links_.end(), crosses), links_.end());
    for (size_t i = 0; i < 40; ++i) made_.walk.keyframes[i].told_world_from_camera = made_.world_from_camera[i];
  }
  double offAfterAdjustment(PoseUse use) const {
    PoseTrust trust;
    trust.use = use;
    PoseBeliefs beliefs(made_.walk.keyframes, trust);
    beliefs.judge(links_);
    FramePoses poses;
    for (size_t i = 0; i < 40; ++i) {
      poses.push_back(made_.world_from_camera[i]);
      if (i >= 20) poses[i] = Rigid{Matrix3::Identity(), Vector3(0.1, 0, 0.05)} * *poses[i];
    }
    adjustToLinks(links_, beliefs, &poses);
    double worst_m = 0;
    for (size_t i = 0; i < 40; ++i)
      worst_m = std::max(worst_m, (made_.world_from_camera[i].translation_m - poses[i]->translation_m).norm());
    return worst_m;
  }
};

TEST_F(BeliefsTest, StepsAndAnchorsHoldWhatNoLinkHolds) {
  EXPECT_GT(offAfterAdjustment(PoseUse::kNone), 0.1);
  EXPECT_LT(offAfterAdjustment(PoseUse::kOdometry), 0.001);
  EXPECT_LT(offAfterAdjustment(PoseUse::kApproximate), 0.001);
}

TEST_F(LoopTest, OtherPartsGetNoPose) {
  const PoseBeliefs none(std::vector<WalkFrame>(42), {});
  const FramePoses poses = posesAlongLinks(links_, connectedParts(42, links_), none);
  EXPECT_TRUE(poses[39]);
  EXPECT_FALSE(poses[40]);
  EXPECT_FALSE(isConsistent(bare(0, 41), poses));
}

}  // namespace
}  // namespace sphc::host
