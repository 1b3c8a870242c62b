// Bad days: the rows of the fault table in docs/drivers_v4l2.md, one test each.
#include <gmock/gmock.h>

#include <cerrno>

#include "opened_camera.h"
#include "tests/support/jpeg_frame.h"

namespace sphc::v4l2 {
namespace {

using ::testing::HasSubstr;

// Bends frame 3 alone.
test::FakeCamera withFrame3(test::FakeCamera fake, std::function<void(test::FakeFrame &)> bend) {
  fake.bend_frame = [bend](test::FakeFrame &frame) {
    if (frame.number == 3) bend(frame);
  };
  return fake;
}

std::vector<uint32_t> sequences(OpenedCamera &camera, int count) {
  std::vector<uint32_t> all;
  for (int i = 0; i < count; ++i) {
    const sphc_capture capture = camera.take();
    all.push_back(capture.sequence);
    camera.release(capture);
  }
  return all;
}

const std::vector<uint32_t> kWithout3 = {0, 1, 2, 4, 5};

// ---- frames ----------------------------------------------------------------------------------------------------

TEST(Fault, DroppedFrameIsAGapAndCounted) {
  RunningCamera running(withFrame3(depthCamera(), [](test::FakeFrame &frame) { frame.is_lost = true; }),
                        configFor(SPHC_STREAM_DEPTH));
  EXPECT_EQ(sequences(running.opened, 5), kWithout3);
  EXPECT_EQ(running.opened.stats().lost, 1u);
  EXPECT_EQ(running.opened.stats().captured, 5u);
}

TEST(Fault, FrameMarkedDamagedIsLeftOutAndCounted) {
  RunningCamera running(
      withFrame3(depthCamera(), [](test::FakeFrame &frame) { frame.flags |= V4L2_BUF_FLAG_ERROR; }),
      configFor(SPHC_STREAM_DEPTH));
  EXPECT_EQ(sequences(running.opened, 5), kWithout3);
  EXPECT_EQ(running.opened.stats().corrupt, 1u);
  EXPECT_EQ(running.opened.stats().lost, 0u) << "it was not lost by the device";
}

TEST(Fault, ShortFrameIsLeftOutAndCounted) {
  for (const uint32_t bytes : {0u, 1u, 2 * kWidth * kHeight - 1}) {
    RunningCamera running(withFrame3(depthCamera(), [&](test::FakeFrame &frame) { frame.bytes_used = bytes; }),
                          configFor(SPHC_STREAM_DEPTH));
    EXPECT_EQ(sequences(running.opened, 5), kWithout3);
    EXPECT_EQ(running.opened.stats().short_frames, 1u);
  }
}

TEST(Fault, FrameLongerThanItsBufferIsLeftOutAndCounted) {
  RunningCamera running(withFrame3(depthCamera(), [](test::FakeFrame &frame) { frame.bytes_used = UINT32_MAX; }),
                        configFor(SPHC_STREAM_DEPTH));
  EXPECT_EQ(sequences(running.opened, 5), kWithout3);
  EXPECT_EQ(running.opened.stats().corrupt, 1u);
}

TEST(Fault, CorruptMjpegIsLeftOutAndCounted) {
  const std::vector<uint8_t> jpeg = test::jpegFrame(test::gradientRgb(kWidth, kHeight), kWidth, kHeight);
  const std::function<void(test::FakeFrame &)> faults[] = {
      [](test::FakeFrame &frame) { frame.bytes_used /= 2; }, [](test::FakeFrame &frame) { frame.bytes_used = 0; },
      [](test::FakeFrame &frame) { std::fill(frame.data, frame.data + 300, uint8_t{0x55}); },
      [](test::FakeFrame &frame) {
        const auto larger = test::jpegFrame(test::gradientRgb(80, 48), 80, 48);
        std::copy(larger.begin(), larger.end(), frame.data);
        frame.bytes_used = static_cast<uint32_t>(larger.size());
      }};
  for (const auto &fault : faults) {
    test::FakeCamera fake({{V4L2_PIX_FMT_MJPEG, kWidth, kHeight, 30}});
    fake.paint = [&](test::FakeFrame &frame) {
      std::copy(jpeg.begin(), jpeg.end(), frame.data);
      frame.bytes_used = static_cast<uint32_t>(jpeg.size());
    };
    RunningCamera running(withFrame3(fake, fault), configFor(SPHC_STREAM_COLOR));
    EXPECT_EQ(sequences(running.opened, 5), kWithout3);
    EXPECT_EQ(running.opened.stats().corrupt, 1u);
  }
}

TEST(Fault, NothingButBadFramesIsAgainWithTheReason) {
  test::FakeCamera fake = depthCamera();
  fake.bend_frame = [](test::FakeFrame &frame) { frame.bytes_used = 10; };
  RunningCamera running(fake, configFor(SPHC_STREAM_DEPTH));
  sphc_capture capture;
  EXPECT_EQ(running.opened.acquire(&capture, 200000), SPHC_AGAIN);
  EXPECT_THAT(running.opened.text(), HasSubstr("no good frame within 200000 us; last one left out:"));
  EXPECT_THAT(running.opened.text(), HasSubstr("10 bytes, but 48 rows"));
  EXPECT_EQ(running.opened.stats().short_frames, 6u) << "at 30 Hz";
}

TEST(Fault, DuplicatedFrameIsLeftOutAndCounted) {
  RunningCamera running(withFrame3(depthCamera(),
                                   [](test::FakeFrame &frame) {
                                     frame.sequence = 2;
                                     frame.time_ns -= kPeriodNs;
                                   }),
                        configFor(SPHC_STREAM_DEPTH));
  EXPECT_EQ(sequences(running.opened, 5), kWithout3);
  EXPECT_EQ(running.opened.stats().duplicated, 1u);
}

TEST(Fault, CountThatStandsStillOrJumpsIsReplacedByOurs) {
  test::FakeCamera fake = depthCamera();
  fake.bend_frame = [](test::FakeFrame &frame) { frame.sequence = 0; };
  RunningCamera still(fake, configFor(SPHC_STREAM_DEPTH));
  EXPECT_EQ(sequences(still.opened, 5), (std::vector<uint32_t>{0, 1, 2, 3, 4}));
  EXPECT_EQ(still.opened.stats().uncounted, 4u);
  fake.bend_frame = [](test::FakeFrame &frame) { frame.sequence *= 1000000; };
  RunningCamera jumping(fake, configFor(SPHC_STREAM_DEPTH));
  EXPECT_EQ(sequences(jumping.opened, 5), (std::vector<uint32_t>{0, 1, 2, 3, 4}));
  EXPECT_EQ(jumping.opened.stats().lost, 0u);
}

TEST(Fault, TimeJumpIsReplacedByArrivalAndCounted) {
  for (const int64_t jump_ns : {int64_t{-3600} * 1000000000, int64_t{3600} * 1000000000, -2 * kPeriodNs}) {
    RunningCamera running(withFrame3(depthCamera(), [&](test::FakeFrame &frame) { frame.time_ns += jump_ns; }),
                          configFor(SPHC_STREAM_DEPTH));
    int64_t last_ns = INT64_MIN;
    for (uint32_t i = 0; i < 6; ++i) {
      const sphc_capture capture = running.opened.take();
      EXPECT_GT(capture.time_ns, last_ns);
      EXPECT_EQ(capture.time_point, i == 3 ? SPHC_TIME_ARRIVAL : SPHC_TIME_START);
      last_ns = capture.time_ns;
      running.opened.release(capture);
    }
    EXPECT_EQ(running.opened.stats().time_replaced, 1u);
  }
}

TEST(Fault, TimeWhoseMicrosecondsAreASecondIsReplaced) {
  test::FakeCamera fake = depthCamera();
  fake.bend_dequeued = [](v4l2_buffer &buffer) {
    --buffer.timestamp.tv_sec;
    buffer.timestamp.tv_usec += 1000000;
  };
  RunningCamera running(std::move(fake), configFor(SPHC_STREAM_DEPTH));
  EXPECT_EQ(running.opened.take().time_point, SPHC_TIME_ARRIVAL);
  EXPECT_EQ(running.opened.stats().time_replaced, 1u);
}

TEST(Fault, FramesThatWaitedWithoutATimeOfTheirOwnAreAsUnsureAsThat) {
  std::vector<int64_t> true_ns(40);
  test::FakeCamera fake = depthCamera();
  fake.time_flags = V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN;
  fake.bend_frame = [&](test::FakeFrame &frame) { true_ns.at(frame.number) = frame.time_ns; };
  RunningCamera running(std::move(fake), configFor(SPHC_STREAM_DEPTH));
  const auto expectSure = [&](int captures, double most_sigma_us) {
    for (int i = 0; i < captures; ++i) {
      const sphc_capture capture = running.opened.take();
      const int64_t late_us = (capture.time_ns - true_ns[capture.sequence]) / 1000;
      EXPECT_LE(late_us, int64_t{capture.time_sigma_us}) << capture.sequence;
      EXPECT_LE(capture.time_sigma_us, most_sigma_us) << capture.sequence;
      running.opened.release(capture);
    }
  };
  const double period_us = kPeriodNs / 1000.0;
  expectSure(3, 1.01 * period_us);
  running.kernel.now_ns += 20 * kPeriodNs;
  expectSure(6, 21.1 * period_us);  // those that waited
  running.opened.release(running.opened.take());
  expectSure(3, 1.01 * period_us);
}

// ---- waiting ---------------------------------------------------------------------------------------------------

TEST(Fault, StallIsAgainUntilItGoesOn) {
  RunningCamera running(depthCamera(), configFor(SPHC_STREAM_DEPTH));
  running.opened.release(running.opened.take());
  running.camera->is_stalled = true;
  for (int i = 0; i < 3; ++i) {
    sphc_capture capture;
    const int64_t begin_ns = running.kernel.now_ns;
    EXPECT_EQ(running.opened.acquire(&capture, 100000), SPHC_AGAIN);
    EXPECT_STREQ(running.opened.text(), "no good frame within 100000 us");
    EXPECT_NEAR(static_cast<double>(running.kernel.now_ns - begin_ns), 100e6, 1e5) << "of the fake kernel's time";
  }
  running.camera->is_stalled = false;
  running.opened.take();
}

TEST(Fault, DeviceThatWakesForNothingDoesNotKeepUs) {
  RunningCamera running(depthCamera(), configFor(SPHC_STREAM_DEPTH));
  running.kernel.failRequest(VIDIOC_DQBUF, EAGAIN, UINT32_MAX);
  sphc_capture capture;
  EXPECT_EQ(running.opened.acquire(&capture, UINT32_MAX), SPHC_AGAIN);
}

TEST(Fault, InterruptedCallsAreMadeAgain) {
  RunningCamera running(depthCamera(), configFor(SPHC_STREAM_DEPTH));
  for (const unsigned long request : {static_cast<unsigned long>(VIDIOC_DQBUF), +test::FakeKernel::kPoll}) {
    running.kernel.failRequest(request, EINTR, 3);
    running.opened.release(running.opened.take());
  }
  running.kernel.failRequest(VIDIOC_DQBUF, EINTR, UINT32_MAX);
  sphc_capture capture;
  EXPECT_EQ(running.opened.acquire(&capture), SPHC_E_DEVICE) << "for ever, but not with us";
}

TEST(Fault, ManySignalsDoNotEndAWaitEarly) {  // as those of a profiler
  RunningCamera running(depthCamera(), configFor(SPHC_STREAM_DEPTH));
  running.kernel.failRequest(test::FakeKernel::kPoll, EINTR, 1000);
  running.opened.take();
}

TEST(Fault, SlowCallerStarvesTheDeviceAndIsTold) {
  RunningCamera running(depthCamera(), configFor(SPHC_STREAM_DEPTH));  // 6 buffers
  sequences(running.opened, 3);
  running.kernel.now_ns += 20 * kPeriodNs;
  running.camera->is_stalled = false;
  EXPECT_EQ(sequences(running.opened, 8), (std::vector<uint32_t>{3, 4, 5, 6, 7, 8, 23, 24}));
  EXPECT_EQ(running.opened.stats().lost, 14u);
  EXPECT_EQ(running.opened.stats().starved, 1u);
}

// ---- errors of calls -------------------------------------------------------------------------------------------

TEST(Fault, ErrorOfACallIsAnErrorOnceAndItGoesOn) {
  RunningCamera running(depthCamera(), configFor(SPHC_STREAM_DEPTH));
  uint64_t errors = 0;
  for (const int error : {EIO, EINVAL, EPIPE, ENOMEM})
    for (const unsigned long request : {static_cast<unsigned long>(VIDIOC_DQBUF), +test::FakeKernel::kPoll}) {
      running.kernel.failRequest(request, error);
      sphc_capture capture;
      EXPECT_EQ(running.opened.acquire(&capture), SPHC_E_DEVICE);
      EXPECT_THAT(running.opened.text(), HasSubstr("errno " + std::to_string(error)));
      EXPECT_EQ(running.opened.stats().device_errors, ++errors);
      running.opened.release(running.opened.take());
    }
}

TEST(Fault, BufferThatCannotBeQueuedIsQueuedLater) {
  RunningCamera running(depthCamera(), configFor(SPHC_STREAM_DEPTH));
  const sphc_capture capture = running.opened.take();
  running.kernel.failRequest(VIDIOC_QBUF, EIO);
  running.opened.release(capture);
  EXPECT_EQ(sequences(running.opened, 20).size(), 20u);
  EXPECT_EQ(running.opened.stats().lost, 0u);
}

TEST(Fault, KernelThatGivesABufferItDoesNotHaveIsNotBelieved) {
  for (const uint32_t index : {6u, UINT32_MAX}) {
    RunningCamera running(depthCamera(), configFor(SPHC_STREAM_DEPTH));
    running.camera->bend_dequeued = [&](v4l2_buffer &buffer) { buffer.index = index; };
    sphc_capture capture;
    EXPECT_EQ(running.opened.acquire(&capture), SPHC_E_DEVICE);
  }
  RunningCamera running(depthCamera(), configFor(SPHC_STREAM_DEPTH));
  running.opened.take();
  running.camera->bend_dequeued = [](v4l2_buffer &buffer) { buffer.index = 0; };
  sphc_capture capture;
  EXPECT_EQ(running.opened.acquire(&capture), SPHC_E_DEVICE) << "that one is on loan";
}

TEST(Fault, StreamThatDoesNotStartCanBeStartedAgain) {
  test::FakeKernel kernel;
  kernel.plugIn(0, depthCamera());
  OpenedCamera camera(kernel, configFor(SPHC_STREAM_DEPTH));
  kernel.failRequest(VIDIOC_STREAMON, ENOSPC);
  EXPECT_EQ(camera.start(), SPHC_E_DEVICE);
  EXPECT_THAT(camera.text(), HasSubstr("too little USB bandwidth"));
  kernel.failRequest(VIDIOC_QBUF, EIO);
  EXPECT_EQ(camera.start(), SPHC_E_DEVICE);
  sphc_capture capture;
  EXPECT_EQ(camera.acquire(&capture), SPHC_E_STATE);
  ASSERT_EQ(camera.start(), SPHC_OK) << camera.text();
  EXPECT_EQ(sequences(camera, 5).size(), 5u);
}

TEST(Fault, StreamGivenUpByTheKernelIsAnErrorAndCanBeStartedAgain) {
  RunningCamera running(depthCamera(), configFor(SPHC_STREAM_DEPTH));
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  const v4l2::Syscalls &calls = running.kernel.syscalls();
  calls.ioctl(calls.self, 1000, VIDIOC_STREAMOFF, &type);  // behind its back
  running.kernel.failRequest(VIDIOC_DQBUF, EAGAIN);
  sphc_capture capture;
  EXPECT_EQ(running.opened.acquire(&capture), SPHC_E_DEVICE);
  EXPECT_THAT(running.opened.text(), HasSubstr("stop and start again"));
  running.opened.stop();
  ASSERT_EQ(running.opened.start(), SPHC_OK);
  running.opened.take();
}

TEST(Fault, StreamGivenUpByTheKernelSaysSoAtEveryAcquireUntilItIsStopped) {
  RunningCamera running(depthCamera(), configFor(SPHC_STREAM_DEPTH));
  for (const int64_t busy_ns : {int64_t{0}, 3 * kPeriodNs}) {
    running.kernel.now_ns += busy_ns;
    running.opened.release(running.opened.take());  // others wait behind it, and nobody gets those any more
    running.camera->is_given_up = true;
    const uint64_t errors = running.opened.stats().device_errors;
    for (uint64_t i = 1; i <= 3; ++i) {
      sphc_capture capture;
      EXPECT_EQ(running.opened.acquire(&capture), SPHC_E_DEVICE);
      EXPECT_THAT(running.opened.text(), HasSubstr("has stopped the stream after an error; stop and start"));
      EXPECT_EQ(running.opened.stats().device_errors, errors + i);
    }
    running.opened.stop();
    ASSERT_EQ(running.opened.start(), SPHC_OK);
    running.opened.release(running.opened.take());
  }
}

TEST(Fault, SignalOfAnotherSizeIsLost) {
  RunningCamera running(depthCamera(), configFor(SPHC_STREAM_DEPTH));
  running.opened.take();
  running.camera->pushEvent(V4L2_EVENT_SOURCE_CHANGE, 0, V4L2_EVENT_SRC_CH_RESOLUTION);
  sphc_capture capture;
  EXPECT_EQ(running.opened.acquire(&capture), SPHC_E_DEVICE_LOST);
  EXPECT_THAT(running.opened.text(), HasSubstr("another size"));
  EXPECT_EQ(running.opened.start(), SPHC_E_STATE) << "a failure of another kind";
  EXPECT_EQ(running.opened.acquire(&capture), SPHC_E_DEVICE_LOST);
  EXPECT_THAT(running.opened.text(), HasSubstr("another size"));
  running.opened.stop();
  EXPECT_EQ(running.opened.start(), SPHC_E_DEVICE_LOST) << "its buffers are those of the size before";
  EXPECT_THAT(running.opened.text(), HasSubstr("another size"));
}

}  // namespace
}  // namespace sphc::v4l2
