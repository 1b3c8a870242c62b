#include "runtime/localizer/rig_extractor.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "runtime/base/random.h"
#include "tests/support/arena_memory.h"
#include "tests/support/scene.h"

namespace sphc {
namespace {

constexpr uint32_t kKeypoints = 120;

// Noise in blocks, of which some are stronger than others.
std::vector<uint8_t> texture(const sphc_camera &camera, uint32_t contrast, uint64_t seed) {
  std::vector<uint8_t> gray(size_t{camera.width} * camera.height);
  Random random(seed);
  std::vector<uint8_t> blocks(64 * 64);
  for (uint8_t &block : blocks) block = static_cast<uint8_t>(128 + random.below(contrast));
  for (size_t i = 0; i < gray.size(); ++i)
    gray[i] = blocks[(i / camera.width / 5 % 64) * 64 + i % camera.width / 5 % 64];
  return gray;
}

class RigExtractorTest : public testing::Test {
 protected:
  RigExtractorTest() : memory_([this](Arena &arena, bool real) { layout(arena, real); }) {
    extractor_.init();
    for (size_t i = 0; i < cameras_.size(); ++i) images_.push_back(texture(cameras_[i], i == 1 ? 100 : 40, i + 1));
  }

  void layout(Arena &arena, bool real) {
    static constexpr const char *kNames[3] = {"keypoints", "descriptors", "cameras"};
    config_ = {};
    config_.max_keypoints = kKeypoints;
    config_.color_camera = Camera(cameras_[0]);
    for (size_t i = 1; i < cameras_.size(); ++i) config_.further.push({Camera(cameras_[i]), Rigid(), 0});
    FeatureRoom::layout(kNames, config_, arena, real ? &room_ : nullptr);
    RigExtractor::layout(config_, arena, arena, real ? &extractor_ : nullptr);
  }
  GrayView grayOf(size_t i) const {
    const sphc_camera &camera = cameras_[i];
    return {images_[i].data(), static_cast<int32_t>(camera.width), static_cast<int32_t>(camera.height),
            static_cast<int32_t>(camera.width)};
  }
  FurtherViews views() const {
    FurtherViews views;
    for (size_t i = 1; i < cameras_.size(); ++i) {
      FurtherView view;
      view.image.bytes = grayOf(i);
      views.push(view);
    }
    return views;
  }
  uint32_t extract(const FurtherViews &further) { return extractor_.extract(grayOf(0), further, room_, {}); }
  uint32_t countOf(uint32_t camera, uint32_t count) const {
    uint32_t seen = 0;
    for (uint32_t i = 0; i < count; ++i) seen += room_.cameraOf(i) == camera;
    return seen;
  }

  std::vector<sphc_camera> cameras_ = {test::pinhole(160, 120, 100), test::pinhole(200, 96, 100),
                                       test::pinhole(96, 176, 100)};
  LocalizerConfig config_;
  std::vector<std::vector<uint8_t>> images_;
  FeatureRoom room_;
  RigExtractor extractor_;
  test::ArenaMemory memory_;
};

TEST_F(RigExtractorTest, EachCameraGetsAnEvenShare) {
  const uint32_t count = extract(views());
  EXPECT_EQ(count, kKeypoints);
  for (uint32_t camera = 0; camera < 3; ++camera) EXPECT_EQ(countOf(camera, count), kKeypoints / 3) << camera;
}

TEST_F(RigExtractorTest, WhatOneLeavesTheOthersGet) {
  std::fill(images_[0].begin(), images_[0].end(), uint8_t{90});
  FurtherViews further = views();
  EXPECT_EQ(countOf(1, extract(further)), kKeypoints / 2);
  further[0].image.bytes.data = nullptr;
  const uint32_t count = extract(further);
  EXPECT_EQ(countOf(2, count), count);
  EXPECT_GT(count, kKeypoints / 2);
}

TEST_F(RigExtractorTest, TheStrongestComeFirst) {
  const uint32_t count = extract(views());
  for (uint32_t i = 1; i < count; ++i) EXPECT_LE(room_.keypoints[i].response, room_.keypoints[i - 1].response);
  EXPECT_GT(countOf(1, kKeypoints / 6), kKeypoints / 9) << "the image of most contrast has most of the strongest";
}

// Keypoints, descriptors and cameras change places together: those of each camera are what it has alone.
TEST_F(RigExtractorTest, WhatBelongsTogetherStaysTogether) {
  FeatureConfig alone;
  alone.max_keypoints = kKeypoints / 3;
  const uint32_t count = extract(views());
  for (uint32_t camera = 0; camera < 3; ++camera) {
    alone.width = static_cast<int32_t>(cameras_[camera].width);
    alone.height = static_cast<int32_t>(cameras_[camera].height);
    FeatureExtractor extractor;
    const test::ArenaMemory memory([&](Arena &arena, bool real) {
      FeatureExtractor::layout(alone, arena, arena, real ? &extractor : nullptr);
    });
    extractor.init();
    std::vector<Keypoint> keypoints(alone.max_keypoints);
    std::vector<Descriptor> descriptors(alone.max_keypoints);
    const uint32_t expected = extractor.extract(grayOf(camera), {keypoints.data(), keypoints.size()},
                                                {descriptors.data(), descriptors.size()});
    uint32_t seen = 0;
    for (uint32_t i = 0; i < count; ++i) {
      if (room_.cameraOf(i) != camera) continue;
      ASSERT_LT(seen, expected);
      EXPECT_EQ(std::memcmp(&room_.keypoints[i], &keypoints[seen], sizeof(Keypoint)), 0);
      EXPECT_EQ(std::memcmp(&room_.descriptors[i], &descriptors[seen], sizeof(Descriptor)), 0);
      ++seen;
    }
    EXPECT_EQ(seen, expected);
  }
}

}  // namespace
}  // namespace sphc
