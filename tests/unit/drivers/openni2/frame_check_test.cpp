#include "drivers/openni2/frame_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "drivers/openni2/streams.h"
#include "runtime/base/random.h"

namespace sphc::openni2 {

namespace {

constexpr int kWidth = 32, kHeight = 24, kBytes = 2 * kWidth * kHeight;
constexpr OniVideoMode kMode = {ONI_PIXEL_FORMAT_DEPTH_1_MM, kWidth, kHeight, 30};

OniFrame goodFrame(std::vector<uint8_t> *pixels) {
  OniFrame frame = {};
  frame.dataSize = static_cast<int>(pixels->size());
  frame.data = pixels->data();
  frame.sensorType = ONI_SENSOR_DEPTH;
  frame.width = kWidth;
  frame.height = kHeight;
  frame.videoMode = kMode;
  frame.stride = 2 * kWidth;
  return frame;
}

TEST(FrameCheck, TakesAGoodFrame) {
  std::vector<uint8_t> pixels(kBytes);
  EXPECT_EQ(checkFrame(goodFrame(&pixels), kDepth, kMode, nullptr), SPHC_OK);
}

TEST(FrameCheck, RefusesAFrameWithoutPixels) {
  std::vector<uint8_t> pixels(kBytes);
  OniFrame frame = goodFrame(&pixels);
  frame.data = nullptr;
  sphc_message message = {};
  EXPECT_EQ(checkFrame(frame, kDepth, kMode, &message), SPHC_E_IMAGE);
  EXPECT_STRNE(message.text, "");
}

// Whatever passes can be read to its last byte: the address sanitizer watches.
TEST(FrameCheck, LetsNothingPassThatCannotBeRead) {
  Random random(7);
  const int values[] = {0, 1, -1, 24, 32, 63, 64, 65, 100, kBytes - 1, kBytes, kBytes + 1, INT32_MAX, INT32_MIN};
  constexpr uint32_t kValues = sizeof values / sizeof values[0];
  int passed = 0;
  for (int i = 0; i < 200000; ++i) {
    std::vector<uint8_t> pixels(random.below(2) ? kBytes : 2 * kBytes);
    OniFrame frame = goodFrame(&pixels);
    int *fields[] = {&frame.width, &frame.height, &frame.stride};
    for (int *field : fields)
      if (random.below(2)) *field = values[random.below(kValues)];
    frame.dataSize = std::min(values[random.below(kValues)], frame.dataSize);  // the library knows its buffer
    if (checkFrame(frame, kDepth, kMode, nullptr) != SPHC_OK) continue;
    ++passed;
    uint32_t sum = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < 2 * kWidth; ++x) sum += pixels.at(static_cast<size_t>(y) * frame.stride + x);
    ASSERT_EQ(sum, 0u);
  }
  EXPECT_GT(passed, 100);
}

TEST(FrameCheck, KnowsTheFormatsItPassesOn) {
  EXPECT_EQ(formatOf(ONI_PIXEL_FORMAT_RGB888), SPHC_FORMAT_RGB8);
  EXPECT_EQ(formatOf(ONI_PIXEL_FORMAT_JPEG), 0);
  EXPECT_EQ(sphc_format_bytes(SPHC_FORMAT_RGB8), 3u);
  EXPECT_EQ(sphc_format_bytes(0), 0u);
}

}  // namespace

}  // namespace sphc::openni2
