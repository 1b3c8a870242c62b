#include "drivers/openni2/capture_queue.h"

#include <gtest/gtest.h>

#include <thread>

namespace sphc::openni2 {

namespace {

constexpr int64_t kPeriodNs = 33000000;
constexpr uint32_t kBuffers = 4;

// Images of one byte, the byte being the sequence.
class CaptureQueueTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(queue_.open(kBuffers, 1));
    queue_.start(config_);
  }
  void restart() {
    queue_.stop();
    queue_.start(config_);
  }
  void push(int stream, int64_t time_ns, uint32_t sequence = 0) {
    sphc_capture capture = {};
    capture.struct_size = sizeof capture;
    capture.stream = streamId(stream);
    capture.time_ns = time_ns;
    capture.sequence = sequence;
    capture.arrival_ns = monotonicNs();
    const uint8_t byte = static_cast<uint8_t>(sequence);
    queue_.push(stream, capture, {&byte, 1, 1, 1});
  }
  sphc_status take(sphc_capture *capture) { return queue_.take(0, capture, &message_); }
  int64_t takeTime() {
    sphc_capture capture = {};
    EXPECT_EQ(take(&capture), SPHC_OK) << message_.text;
    return capture.time_ns;
  }

  QueueConfig config_ = {false, {true, true}, {kPeriodNs, kPeriodNs}, int64_t{1} << 50, int64_t{1} << 50};
  CaptureQueue queue_;
  sphc_message message_ = {};
};

TEST(CaptureQueueMemory, IsRefusedWhereItsSizeCannotBeCounted) {
  CaptureQueue queue;
  EXPECT_FALSE(queue.open(kMaxBuffers, SIZE_MAX / kMaxBuffers + 1)) << "on 32-bit boards the largest modes are so";
  EXPECT_FALSE(queue.open(2, SIZE_MAX));
}

TEST_F(CaptureQueueTest, GivesTheEarlierStreamFirst) {
  push(kDepth, 200, 1);
  push(kColor, 100, 2);
  EXPECT_EQ(takeTime(), 100);
  EXPECT_EQ(takeTime(), 200) << "the next colour is a period away";
}

TEST_F(CaptureQueueTest, WaitsWhileAnOlderOneMayCome) {
  push(kDepth, 200, 1);
  sphc_capture capture = {};
  EXPECT_EQ(take(&capture), SPHC_AGAIN) << "no colour so far";
  config_.order_wait_ns = 0;
  restart();
  push(kDepth, 200, 1);
  EXPECT_EQ(take(&capture), SPHC_OK);
}

TEST_F(CaptureQueueTest, DoesNotWaitForAStreamThatDoesNotRun) {
  config_.runs[kColor] = false;
  restart();
  push(kDepth, 200, 1);
  EXPECT_EQ(takeTime(), 200);
}

TEST_F(CaptureQueueTest, ThrowsTheOldestAwayWhenFull) {
  config_.runs[kColor] = false;
  restart();
  for (uint32_t i = 1; i <= kBuffers + 2; ++i) push(kDepth, i * kPeriodNs, i);
  sphc_openni2_counts color = {}, depth = {};
  queue_.copyCounts(&color, &depth);
  EXPECT_EQ(depth.overrun, 2u);
  for (uint32_t i = 3; i <= kBuffers + 2; ++i) {
    sphc_capture capture = {};
    ASSERT_EQ(take(&capture), SPHC_OK);
    EXPECT_EQ(capture.sequence, i);
    EXPECT_EQ(*static_cast<const uint8_t *>(capture.image.data), i);
  }
}

TEST_F(CaptureQueueTest, NeverGoesBackInTime) {
  config_.order_wait_ns = 0;
  restart();
  push(kDepth, 200, 1);
  EXPECT_EQ(takeTime(), 200);
  push(kColor, 199, 1);
  push(kColor, 200, 2);
  EXPECT_EQ(takeTime(), 200) << "the same time of another stream is no step back";
  sphc_openni2_counts color = {}, depth = {};
  queue_.copyCounts(&color, &depth);
  EXPECT_EQ(color.late, 1u);
}

TEST_F(CaptureQueueTest, SaysNewsOnceAndBeforeCaptures) {
  push(kDepth, 1, 1);
  push(kColor, 1, 1);
  queue_.report(SPHC_E_IMAGE, "first");
  queue_.report(SPHC_E_DEVICE, "second");
  sphc_capture capture = {};
  EXPECT_EQ(take(&capture), SPHC_E_IMAGE);
  EXPECT_STREQ(message_.text, "first");
  EXPECT_EQ(take(&capture), SPHC_OK);
}

TEST_F(CaptureQueueTest, GivesTheRestBeforeTheEnd) {
  push(kDepth, 1, 1);
  queue_.deviceGone();
  EXPECT_EQ(takeTime(), 1);
  sphc_capture capture = {};
  EXPECT_EQ(take(&capture), SPHC_E_DEVICE_LOST);
}

TEST_F(CaptureQueueTest, WakesTheOneWhoWaits) {
  std::thread other([this] {
    push(kDepth, 1, 1);
    push(kColor, 1, 1);
  });
  sphc_capture capture = {};
  EXPECT_EQ(queue_.take(monotonicNs() + int64_t{60} * 1000000000, &capture, &message_), SPHC_OK);
  other.join();
}

TEST_F(CaptureQueueTest, ForgetsWhatWaitedWhenStopped) {
  push(kDepth, 1, 1);
  push(kColor, 1, 1);
  restart();
  sphc_capture capture = {};
  EXPECT_EQ(take(&capture), SPHC_AGAIN);
  queue_.stop();
  push(kDepth, 2, 2);
  EXPECT_EQ(take(&capture), SPHC_E_STATE);
}

}  // namespace

}  // namespace sphc::openni2
