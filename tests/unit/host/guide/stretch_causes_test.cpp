#include "host/guide/stretch_causes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "host/mapping/walk_mapper.h"
#include "made_up_wall.h"

namespace sphc::host {
namespace {

using testing::HasSubstr;

constexpr int64_t kPaceNs = 100000000;

// Walks along a wall, in which some frames are spoiled, and maps it.
class StretchCausesTest : public testing::Test {
 protected:
  using Spoil = std::function<void(std::vector<uint8_t> *gray, std::vector<uint16_t> *depth_mm)>;

  void look(int x_px, int64_t gap_ns = kPaceNs, const Spoil &spoil = {}) {
    time_ns_ += gap_ns;
    sphc_localizer_frame images = wall_.view(x_px, time_ns_);
    constexpr size_t kPixels = size_t{kWallViewWidth} * kWallViewHeight;
    const auto *gray = static_cast<const uint8_t *>(images.color.data);
    const auto *depth = static_cast<const uint16_t *>(images.depth.data);
    std::vector<uint8_t> spoiled_gray(gray, gray + kPixels);
    std::vector<uint16_t> spoiled_depth(depth, depth + kPixels);
    if (spoil) spoil(&spoiled_gray, &spoiled_depth);
    images.color.data = spoiled_gray.data();
    images.depth.data = spoiled_depth.data();
    walk_.keyframes.push_back(reader_.describe(images));
    walk_.keyframes.back().index = static_cast<uint32_t>(walk_.keyframes.size() - 1);
    walk_.keyframes.back().time_ns = time_ns_;
    walk_.keyframes.back().gap_ns = walk_.keyframes.size() > 1 ? gap_ns : 0;
  }
  // Seven views, three that are spoiled, and seven more.
  void walkPast(const Spoil &spoil) {
    for (int i = 0; i < 17; ++i) look(20 * i, kPaceNs, i >= 7 && i < 10 ? spoil : Spoil());
  }
  std::vector<Stretch> leftOut() {
    walk_.middle_depth_m = kWallM;
    const MappedWalk mapped = mapWalk(walk_, {}, {});
    return stretchesOf(walk_, mapped.parts, mapped.world_from_camera).left_out;
  }
  // Of the one stretch that was left out.
  std::vector<StretchCause> causes() {
    const std::vector<Stretch> left_out = leftOut();
    EXPECT_EQ(left_out.size(), 1u);
    return left_out.empty() ? std::vector<StretchCause>() : causesOf(left_out[0]);
  }
  void expectOneCause(const std::string &name, const std::string &measured, const std::string &cure) {
    const std::vector<StretchCause> found = causes();
    ASSERT_EQ(found.size(), 1u) << causesText(found);
    EXPECT_EQ(found[0].name, name);
    EXPECT_THAT(found[0].measured, HasSubstr(measured));
    EXPECT_THAT(found[0].cure, HasSubstr(cure));
  }

  MadeUpWall wall_{1};
  FrameReader reader_{wallRig(), {}};
  Walk walk_;
  int64_t time_ns_ = 0;
};

void scale(double contrast, double light, std::vector<uint8_t> *gray) {
  for (uint8_t &pixel : *gray) pixel = static_cast<uint8_t>(light * (128 + contrast * (pixel - 128.0)));
}

void blur(size_t length_px, std::vector<uint8_t> *gray) {
  const std::vector<uint8_t> sharp = *gray;
  for (size_t i = 0; i + length_px < sharp.size(); ++i) {
    uint32_t sum = 0;
    for (size_t k = 0; k < length_px; ++k) sum += sharp[i + k];
    (*gray)[i] = static_cast<uint8_t>(sum / length_px);
  }
}

TEST_F(StretchCausesTest, OfAHealthyWalkNothingIsSaid) {
  walkPast({});
  EXPECT_TRUE(leftOut().empty());
}

TEST_F(StretchCausesTest, DarkFramesNeedLight) {
  walkPast([](std::vector<uint8_t> *gray, auto *) { scale(1, 0.02, gray); });
  const std::vector<StretchCause> found = causes();
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].name, "too dark");
  EXPECT_THAT(found[0].measured, HasSubstr("grey level 2 of 255"));
  EXPECT_EQ(found[0].cure, "more light");
}

TEST_F(StretchCausesTest, PlainFramesNeedTexture) {
  walkPast([](std::vector<uint8_t> *gray, auto *) { scale(0, 1, gray); });
  expectOneCause("too plain", "0 keypoints", "more texture");
}

TEST_F(StretchCausesTest, BlurredFramesNeedASlowerWalk) {
  walkPast([](std::vector<uint8_t> *gray, auto *) { blur(48, gray); });
  expectOneCause("too fast", "blurred along a line", "slower");
}

TEST_F(StretchCausesTest, WhatIsTooNearIsToldApartFromWhatIsTooFar) {
  walkPast([](auto *, std::vector<uint16_t> *depth_mm) { std::fill(depth_mm->begin(), depth_mm->end(), 200); });
  expectOneCause("too near", "0 % of the keypoints have depth, 100 % of the depths are nearer", "step back");
}

TEST_F(StretchCausesTest, WhatIsTooFarNeedsAStepCloser) {
  walkPast([](auto *, std::vector<uint16_t> *depth_mm) { std::fill(depth_mm->begin(), depth_mm->end(), 7000); });
  expectOneCause("too far", "100 % of the depths are beyond", "step closer");
}

TEST_F(StretchCausesTest, WithoutAnyDepthTheGuidesWordsAreSaid) {
  walkPast([](auto *, std::vector<uint16_t> *depth_mm) { std::fill(depth_mm->begin(), depth_mm->end(), 0); });
  expectOneCause("no depth", "0 % of the keypoints", "step back or closer");
}

TEST_F(StretchCausesTest, AJumpAcrossTheStretchIsTooFast) {
  for (int i = 0; i < 7; ++i) look(20 * i);
  look(900);
  for (int i = 0; i < 7; ++i) look(290 + 20 * i);  // 170 px in 0.2 s: 3.4 focal lengths a second
  expectOneCause("too fast", "around it the view moves by 3.", "slower");
}

TEST_F(StretchCausesTest, AGapInTimeIsNamed) {
  for (int i = 0; i < 10; ++i) look(20 * i);
  look(1000, 80 * kPaceNs);
  look(1020);
  expectOneCause("gap in time", "no frame for 8.0 s", "without a pause");
}

TEST_F(StretchCausesTest, WhereNothingIsWrongAnotherLookIsAskedFor) {
  for (int i = 0; i < 10; ++i) look(20 * i);
  look(1000);
  look(1020);
  const std::vector<StretchCause> found = causes();
  EXPECT_TRUE(found.empty());
  EXPECT_THAT(causesText(found), HasSubstr("look at this corner again"));
}

TEST(StretchCausesTextTest, EachCauseStandsBesideItsCure) {
  EXPECT_EQ(
      causesText({{"too dark", "median grey level 6 of 255", "more light"}, {"too fast", "blurred", "slower"}}),
      "too dark (median grey level 6 of 255): more light; too fast (blurred): slower");
}

}  // namespace
}  // namespace sphc::host
