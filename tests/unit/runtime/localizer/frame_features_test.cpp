#include "runtime/localizer/frame_features.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/arena_memory.h"
#include "tests/support/scene.h"

namespace sphc {
namespace {

constexpr int32_t kImageWidth = 16, kImageHeight = 16, kImageStride = 19;

class FrameFeaturesTest : public testing::Test {
 protected:
  static LocalizerConfig config() {
    LocalizerConfig config;
    config.max_keypoints = 64;
    config.color_camera = Camera(test::pinhole(kImageWidth, kImageHeight, 20));
    return config;
  }
  uint8_t grayAt(int32_t x, int32_t y) const { return features_.gray.row(y)[x]; }

  FrameFeatures features_;
  test::ArenaMemory memory_{[this](Arena &arena, bool has_memory) {
    FrameFeatures::layout(config(), arena, has_memory ? &features_ : nullptr);
  }};
};

TEST_F(FrameFeaturesTest, HasRoomForAFrame) {
  EXPECT_EQ(features_.room.keypoints.size(), 64u);
  EXPECT_EQ(features_.room.descriptors.size(), 64u);
  EXPECT_EQ(features_.gray_room.size(), size_t{kImageWidth * kImageHeight});
}

// An image that is read in place has rows of any stride, and is gone afterwards.
TEST_F(FrameFeaturesTest, KeepsWhatIsReadInPlace) {
  std::vector<uint8_t> bytes(kImageStride * kImageHeight);
  for (size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<uint8_t>(i);
  features_.keepGray({{bytes.data(), kImageWidth, kImageHeight, kImageStride}, LumaLayout()});
  bytes.assign(bytes.size(), 0xFF);
  for (int32_t y = 0; y < kImageHeight; ++y)
    for (int32_t x = 0; x < kImageWidth; ++x) EXPECT_EQ(grayAt(x, y), static_cast<uint8_t>(y * kImageStride + x));
}

TEST_F(FrameFeaturesTest, KeepsWhatIsMadeGrey) {
  LumaLayout rgb;
  rgb.kind = LumaLayout::kRgb;
  rgb.group_bytes = 3;
  const std::vector<uint8_t> white(3 * kImageWidth * kImageHeight, 255);
  features_.keepGray({{white.data(), kImageWidth, kImageHeight, 3 * kImageWidth}, rgb});
  EXPECT_EQ(features_.gray.data, features_.gray_room.data());
  EXPECT_EQ(grayAt(0, 0), 255);
  EXPECT_EQ(grayAt(kImageWidth - 1, kImageHeight - 1), 255);
}

}  // namespace
}  // namespace sphc
