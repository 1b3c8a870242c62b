#include "host/mapping/stretch_evidence.h"

#include <gtest/gtest.h>

#include "made_up_walk.h"

namespace sphc::host {
namespace {

class StretchEvidenceTest : public testing::Test {
 protected:
  StretchEvidenceTest() {
    for (size_t i = 0; i < made_.walk.keyframes.size(); ++i) {
      poses_.push_back(made_.world_from_camera[i]);
      made_.walk.keyframes[i].gap_ns = i > 0 ? 500000000 : 0;
    }
  }
  StretchEvidence evidence(uint32_t first, uint32_t last) {
    for (uint32_t i = first; i <= last; ++i) poses_[i].reset();
    return evidenceOf(made_.walk, first, last, poses_);
  }
  MadeUpWalk made_ = makeWalk({});
  FramePoses poses_;
};

// A turn of 9 degrees, and a little way, each half second.
TEST_F(StretchEvidenceTest, TheSpeedIsOfThePosesAroundIt) { EXPECT_NEAR(evidence(10, 12).view_per_s, 0.36, 0.1); }

TEST_F(StretchEvidenceTest, TheSpeedAcrossTheStretchCounts) {
  *poses_[13] = Rigid{rotationFromVector(Vector3(0, 3, 0)), Vector3::Zero()} * *poses_[13];
  EXPECT_GT(evidence(12, 12).view_per_s, 2);
}

TEST_F(StretchEvidenceTest, WithoutPosesThereIsNoSpeed) { EXPECT_EQ(evidence(0, 39).view_per_s, 0); }

TEST_F(StretchEvidenceTest, GapsBeforeAndAfterItCount) {
  made_.walk.keyframes[13].gap_ns = 7000000000;
  const StretchEvidence found = evidence(10, 12);
  EXPECT_DOUBLE_EQ(found.gap_s, 7);
  EXPECT_DOUBLE_EQ(found.usual_gap_s, 0.5);
  EXPECT_DOUBLE_EQ(evidence(10, 11).gap_s, 0.5);
}

TEST_F(StretchEvidenceTest, OtherRecordingsSayNothing) {
  for (uint32_t i = 13; i < 40; ++i) made_.walk.keyframes[i].recording = 1;
  made_.walk.keyframes[13].gap_ns = 7000000000;
  EXPECT_DOUBLE_EQ(evidence(10, 12).gap_s, 0.5);
}

TEST_F(StretchEvidenceTest, WhatImagesShowIsTheMedian) {
  made_.walk.keyframes[10].evidence.level = 3;
  made_.walk.keyframes[11].evidence.level = 200;
  made_.walk.keyframes[12].evidence.level = 5;
  EXPECT_EQ(evidence(10, 12).images.level, 5);
}

}  // namespace
}  // namespace sphc::host
