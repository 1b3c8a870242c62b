#include "host/frames/frame_features.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/refusal.h"

namespace sphc::host {
namespace {

TEST(FrameFeatures, WhatTheStageDoesNotTakeIsRefused) {
  using testing::HasSubstr;
  EXPECT_THAT(test::refusal([] { FrameFeatures(640, 8, 100); }), HasSubstr("16 to 8192 pixels"));
  EXPECT_THAT(test::refusal([] { FrameFeatures(640, 480, 0); }), HasSubstr("1 to 65536 keypoints"));
  EXPECT_EQ(test::refusal([] { FrameFeatures(16, 16, 1); }), "");
}

TEST(FrameFeatures, APlainImageHasNone) {
  FrameFeatures features(64, 48, 100);
  const std::vector<uint8_t> grey(64 * 48, 128);
  features.extract({grey.data(), 64, 48, 64});
  EXPECT_EQ(features.count(), 0u);
}

}  // namespace
}  // namespace sphc::host
