#include "host/mapping/stretches.h"

#include <gtest/gtest.h>

namespace sphc::host {
namespace {

class StretchesTest : public testing::Test {
 protected:
  StretchesTest() { walk_.keyframes.resize(20); }
  Walk walk_;
};

TEST_F(StretchesTest, AWholeWalkIsOneStretch) {
  walk_.followers.resize(3);
  const Stretches stretches = stretchesOf(walk_, std::vector<uint32_t>(20, 0), FramePoses(20));
  ASSERT_EQ(stretches.mapped.size(), 1u);
  EXPECT_EQ(stretches.mapped[0].last, 19u);
  EXPECT_EQ(stretches.mapped[0].frames, 23u);
  EXPECT_TRUE(stretches.apart.empty());
  EXPECT_TRUE(stretches.left_out.empty());
}

TEST_F(StretchesTest, AStretchEndsWithItsRecording) {
  for (uint32_t i = 12; i < 20; ++i) walk_.keyframes[i].recording = 1;
  const Stretches stretches = stretchesOf(walk_, std::vector<uint32_t>(20, 0), FramePoses(20));
  ASSERT_EQ(stretches.mapped.size(), 2u);
  EXPECT_EQ(stretches.mapped[0].last, 11u);
  EXPECT_EQ(stretches.mapped[1].first, 12u);
}

TEST_F(StretchesTest, APartThatNeverMetIsNamedByItsStretches) {
  std::vector<uint32_t> parts(20, 0);
  for (uint32_t i : {4u, 5u, 6u, 15u, 16u}) parts[i] = 1;
  const Stretches stretches = stretchesOf(walk_, parts, FramePoses(20));
  ASSERT_EQ(stretches.apart.size(), 1u);
  ASSERT_EQ(stretches.apart[0].size(), 2u);
  EXPECT_EQ(stretches.apart[0][0].first, 4u);
  EXPECT_EQ(stretches.apart[0][1].last, 16u);
  EXPECT_EQ(stretches.mapped.size(), 3u);
}

TEST_F(StretchesTest, SingleFramesAreLeftOutAndSayWhy) {
  std::vector<uint32_t> parts(20, 0);
  parts[7] = 1;
  parts[8] = 2;
  parts[9] = 3;
  walk_.keyframes[7].hints = walk_.keyframes[8].hints = kTooFast;
  walk_.keyframes[9].hints = kTooDark;
  const Stretches stretches = stretchesOf(walk_, parts, FramePoses(20));
  ASSERT_EQ(stretches.left_out.size(), 1u);
  EXPECT_EQ(stretches.left_out[0].frames, 3u);
  EXPECT_EQ(stretches.left_out[0].hints, kTooFast);
  EXPECT_TRUE(stretches.apart.empty());
}

}  // namespace
}  // namespace sphc::host
