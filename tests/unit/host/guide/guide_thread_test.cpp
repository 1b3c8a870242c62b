#include "host/guide/guide_thread.h"

#include <gtest/gtest.h>

#include <future>
#include <stdexcept>

#include "made_up_wall.h"

namespace sphc::host {
namespace {

// What a recording relies on: it is never made to wait.
TEST(GuideThreadTest, WhileItIsBusyFramesAreRefusedAtOnce) {
  MadeUpWall wall(1);
  std::promise<void> may_end;
  const std::shared_future<void> end = may_end.get_future().share();
  uint32_t seen = 0;
  GuideThread thread([&](const sphc_localizer_frame &) {
    end.wait();
    ++seen;
  });
  EXPECT_TRUE(thread.offer(wall.view(0, 1)));
  for (int i = 0; i < 50; ++i) EXPECT_FALSE(thread.offer(wall.view(0, 2 + i)));
  may_end.set_value();
  thread.wait();
  EXPECT_EQ(seen, 1u);
  EXPECT_TRUE(thread.offer(wall.view(0, 100)));
  thread.wait();
  EXPECT_EQ(seen, 2u);
}

TEST(GuideThreadTest, ImagesAreItsOwn) {
  std::vector<uint8_t> pixels(16, 7), depth(32);
  sphc_localizer_frame frame = {};
  frame.color = {pixels.data(), 3, 4, 4, SPHC_FORMAT_GRAY8};
  frame.depth = {depth.data(), 4, 4, 8, SPHC_FORMAT_DEPTH16};
  std::promise<void> may_look;
  uint32_t stride_bytes = 0, pixel = 0;
  GuideThread thread([&](const sphc_localizer_frame &seen) {
    may_look.get_future().wait();
    stride_bytes = seen.color.stride_bytes;
    pixel = static_cast<const uint8_t *>(seen.color.data)[11];
  });
  EXPECT_TRUE(thread.offer(frame));
  pixels.assign(16, 9);
  may_look.set_value();
  thread.wait();
  EXPECT_EQ(stride_bytes, 3u);
  EXPECT_EQ(pixel, 7u);
}

TEST(GuideThreadTest, AFailureEndsTheGuideAndNothingElse) {
  MadeUpWall wall(1);
  GuideThread thread([](const sphc_localizer_frame &) { throw std::runtime_error("no reader"); });
  EXPECT_TRUE(thread.offer(wall.view(0, 1)));
  thread.wait();
  EXPECT_EQ(thread.failure(), "no reader");
  EXPECT_FALSE(thread.offer(wall.view(0, 2)));
}

}  // namespace
}  // namespace sphc::host
