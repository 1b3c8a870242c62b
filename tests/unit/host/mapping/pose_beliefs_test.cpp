#include "host/mapping/pose_beliefs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "made_up_walk.h"

namespace sphc::host {
namespace {

class PoseBeliefsTest : public testing::Test {
 protected:
  PoseBeliefsTest() {
    for (size_t i = 0; i < 40; ++i) frames()[i].told_world_from_camera = made_.world_from_camera[i];
    for (uint32_t i = 0; i + 1 < 40; ++i) links_.push_back(exactLink(made_, {i, i + 1}, 100));
    trust_.use = PoseUse::kOdometry;
  }
  std::vector<WalkFrame> &frames() { return made_.walk.keyframes; }
  PoseBeliefs judged() {
    PoseBeliefs beliefs(frames(), trust_);
    beliefs.judge(links_);
    return beliefs;
  }
  size_t anchorsOf(const PoseBeliefs &beliefs) const {
    size_t count = 0;
    for (const auto &anchor : beliefs.anchors()) count += anchor.has_value();
    return count;
  }
  MadeUpWalk made_ = makeWalk({});
  std::vector<FrameLink> links_;
  PoseTrust trust_;
};

TEST_F(PoseBeliefsTest, StepsAreLessSureTheLongerTheyAre) {
  const PoseBeliefs beliefs(frames(), trust_);
  ASSERT_EQ(beliefs.steps().size(), 39u);
  const FrameLink &step = beliefs.steps()[3];
  const double way_m = step.b_from_a.translation_m.norm();
  EXPECT_NEAR(std::sqrt(step.covariance(3, 3)), 0.01 * std::sqrt(way_m), 1e-9);
  EXPECT_EQ(step.inliers, 0u);
}

TEST_F(PoseBeliefsTest, NothingIsToldWhereNothingIsAskedFor) {
  trust_.use = PoseUse::kNone;
  const PoseBeliefs beliefs = judged();
  EXPECT_TRUE(beliefs.steps().empty());
  EXPECT_FALSE(beliefs.hasAnchors());
  EXPECT_EQ(beliefs.toldCount(), 0u);
}

TEST_F(PoseBeliefsTest, NoStepLeadsFromOneRecordingToTheNext) {
  for (size_t i = 20; i < 40; ++i) frames()[i].recording = 1;
  EXPECT_EQ(PoseBeliefs(frames(), trust_).steps().size(), 38u);
}

// Slow enough to be a step, but nothing was told in between.
TEST_F(PoseBeliefsTest, NoStepLeadsAcrossALossOfTheTracking) {
  for (size_t i = 20; i < 40; ++i) frames()[i].told_piece = 1;
  links_.clear();
  const PoseBeliefs beliefs = judged();
  EXPECT_EQ(beliefs.steps().size(), 38u);
  EXPECT_EQ(beliefs.toldCount(), 38u);
  const std::vector<uint32_t> parts = beliefs.parts({});
  EXPECT_EQ(parts[19], 0u);
  EXPECT_EQ(parts[20], 1u);
}

TEST_F(PoseBeliefsTest, AJumpIsNoStepEvenWhereNoImageSaysSo) {
  frames()[20].told_world_from_camera->translation_m.x() += 100;
  links_.clear();
  const PoseBeliefs beliefs = judged();
  EXPECT_EQ(beliefs.steps().size(), 37u);
  EXPECT_EQ(beliefs.toldCount(), 39u);
}

TEST_F(PoseBeliefsTest, StepsThatLinksContradictAreLeftOutAndAllWhereMostAre) {
  frames()[20].told_world_from_camera->translation_m.x() += 0.5;
  EXPECT_EQ(judged().steps().size(), 37u);
  links_.resize(30);  // none of the last steps
  for (size_t i = 0; i < 40; i += 2) frames()[i].told_world_from_camera->translation_m.x() += 0.5;
  EXPECT_TRUE(judged().steps().empty());
}

TEST_F(PoseBeliefsTest, OfTwoWorldsTheLargerIsBelieved) {
  trust_.use = PoseUse::kApproximate;
  for (size_t i = 30; i < 40; ++i) frames()[i].told_world_from_camera->translation_m.z() += 100;
  const PoseBeliefs beliefs = judged();
  EXPECT_EQ(anchorsOf(beliefs), 30u);
  EXPECT_FALSE(beliefs.anchors()[35]);
  EXPECT_EQ(beliefs.contradictedBy({made_.world_from_camera.begin(), made_.world_from_camera.end()}), 10u);
}

// No link tells how the two halves lie to each other; the poses do, and a frame without links connects nothing.
TEST_F(PoseBeliefsTest, AllOfAShortWalkAreBelieved) {
  trust_.use = PoseUse::kApproximate;
  frames().resize(3);
  links_.resize(2);
  EXPECT_EQ(anchorsOf(judged()), 3u);
  frames()[1].told_world_from_camera->translation_m.z() += 100;
  EXPECT_EQ(anchorsOf(judged()), 0u);
}

TEST_F(PoseBeliefsTest, WhatTheMapDisprovesHoldsNoWorld) {
  trust_.use = PoseUse::kApproximate;
  PoseBeliefs beliefs = judged();
  FramePoses mapped(made_.world_from_camera.begin(), made_.world_from_camera.end());
  beliefs.dropDisproved(mapped);
  EXPECT_TRUE(beliefs.hasAnchors());
  for (size_t i = 0; i < 19; ++i) mapped[i]->translation_m.x() += 100;
  beliefs.dropDisproved(mapped);
  EXPECT_TRUE(beliefs.hasAnchors()) << "the most hold";
  for (size_t i = 19; i < 21; ++i) mapped[i]->translation_m.x() += 100;
  beliefs.dropDisproved(mapped);
  EXPECT_FALSE(beliefs.hasAnchors());
}

TEST_F(PoseBeliefsTest, AnchorsConnectPartsThatImagesDoNot) {
  trust_.use = PoseUse::kApproximate;
  links_.erase(links_.begin() + 18, links_.begin() + 21);
  const std::vector<uint32_t> parts = judged().parts(links_);
  EXPECT_EQ(parts[5], 0u);
  EXPECT_EQ(parts[35], 0u);
  EXPECT_NE(parts[19], 0u);
}

TEST_F(PoseBeliefsTest, AnchorsOfOtherPartsAreLeftOut) {
  trust_.use = PoseUse::kApproximate;
  PoseBeliefs beliefs = judged();
  std::vector<uint32_t> parts(40, 1);
  parts[7] = 0;
  beliefs.dropOutside(parts);
  EXPECT_EQ(anchorsOf(beliefs), 1u);
  EXPECT_TRUE(beliefs.anchors()[7]);
}

TEST_F(PoseBeliefsTest, PosesByChanceAreNotBelieved) {
  trust_.use = PoseUse::kApproximate;
  for (size_t i = 0; i < 40; ++i)
    frames()[i].told_world_from_camera->translation_m = Vector3(double(i * 7 % 11), double(i * 5 % 13), 0);
  EXPECT_FALSE(judged().hasAnchors());
}

TEST(ToldAxesTest, DriftAboutTheVerticalLeavesTheVertical) {
  FramePoses told, mapped;
  const Matrix3 tilt = rotationFromVector(Vector3(0.4, 0, 0.2));
  for (int i = 0; i < 9; ++i) {
    const Matrix3 camera = rotationFromVector(Vector3(0.3 * i, 0.1, -0.2 * i));
    mapped.push_back(Rigid{camera, Vector3::Zero()});
    told.push_back(Rigid{rotationFromVector(Vector3(0, 0.05 * i, 0)) * tilt * camera, Vector3::Zero()});
  }
  told.push_back(std::nullopt);
  mapped.push_back(Rigid());
  const Matrix3 told_from_mapped = toldAxesFromMapped(told, mapped);
  EXPECT_TRUE((told_from_mapped * tilt.transpose() * Vector3::UnitY()).isApprox(Vector3::UnitY(), 1e-9));
  EXPECT_NEAR(told_from_mapped.determinant(), 1, 1e-9);
}

}  // namespace
}  // namespace sphc::host
