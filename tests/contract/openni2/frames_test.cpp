// Frames as they should come, and every way in which they should not.
#include <gmock/gmock.h>

#include "open_camera.h"

namespace sphc::contract {

namespace {

using ::testing::HasSubstr;

constexpr uint64_t kFramePeriodUs = vtof::kPeriodUs;

class Frames : public VirtualCameras {
 protected:
  // Emits and takes one, so that its place in the order is sure.
  static void pass(const OpenCamera &camera, const vtof::Frame &frame) {
    ASSERT_TRUE(vtof::emit(0, frame));
    ASSERT_EQ(camera.next(), SPHC_OK) << camera.message();
  }
  static sphc_openni2_config depthOnly() {
    sphc_openni2_config config = cameraConfig();
    config.streams = SPHC_OPENNI2_STREAM_DEPTH;
    return config;
  }
  static vtof::Frame depth(int index) {
    return plainFrame(ONI_SENSOR_DEPTH, index, static_cast<uint64_t>(index) * kFramePeriodUs);
  }
};

TEST_F(Frames, ComeWithEveryByteAndField) {
  const OpenCamera camera;
  ASSERT_EQ(camera.start(), SPHC_OK);
  vtof::emitPair(0, 7, 5000);
  for (const sphc_stream stream : {SPHC_STREAM_COLOR, SPHC_STREAM_DEPTH}) {
    const bool is_color = stream == SPHC_STREAM_COLOR;
    sphc_capture capture = {};
    ASSERT_EQ(camera.acquire(&capture), SPHC_OK) << camera.message();
    EXPECT_EQ(capture.stream, stream) << "colour is 5 ms older";
    EXPECT_EQ(capture.sequence, 7u);
    EXPECT_EQ(capture.time_ns, 1000 * static_cast<int64_t>(7 * kFramePeriodUs + (is_color ? 0 : 5000)));
    EXPECT_EQ(capture.clock, SPHC_CLOCK_SOURCE);
    EXPECT_EQ(capture.time_point, SPHC_TIME_END);
    EXPECT_EQ(capture.time_sigma_us, kFramePeriodUs / 2);
    EXPECT_GT(capture.arrival_ns, 0);
    EXPECT_EQ(capture.image.width, 320u);
    EXPECT_EQ(capture.image.height, 240u);
    EXPECT_EQ(capture.image.stride_bytes, is_color ? 960u : 640u);
    const uint8_t *bytes = static_cast<const uint8_t *>(capture.image.data);
    for (size_t i = 0; i < size_t{capture.image.stride_bytes} * 240; ++i)
      ASSERT_EQ(bytes[i], vtof::pattern(is_color ? ONI_SENSOR_COLOR : ONI_SENSOR_DEPTH, 7, i));
    camera.release(capture);
  }
  EXPECT_EQ(camera.next(kSoonUs), SPHC_AGAIN);
}

TEST_F(Frames, TakeTheTimePointAndSigmaOfTheConfig) {
  sphc_openni2_config config = depthOnly();
  config.time_point = SPHC_TIME_MIDDLE;
  config.time_sigma_us = 250;
  const OpenCamera camera(config);
  ASSERT_EQ(camera.start(), SPHC_OK);
  ASSERT_TRUE(vtof::emit(0, depth(1)));
  sphc_capture capture = {};
  ASSERT_EQ(camera.acquire(&capture), SPHC_OK);
  EXPECT_EQ(capture.time_point, SPHC_TIME_MIDDLE);
  EXPECT_EQ(capture.time_sigma_us, 250u);
}

TEST_F(Frames, AreCopiedRowByRowWhenRowsHaveGaps) {
  const OpenCamera camera(depthOnly());
  ASSERT_EQ(camera.start(), SPHC_OK);
  vtof::Frame frame = depth(3);
  frame.stride_bytes = 1000;
  ASSERT_TRUE(vtof::emit(0, frame));
  sphc_capture capture = {};
  ASSERT_EQ(camera.acquire(&capture), SPHC_OK) << camera.message();
  ASSERT_EQ(capture.image.stride_bytes, 640u);
  const uint8_t *bytes = static_cast<const uint8_t *>(capture.image.data);
  for (size_t i = 0; i < size_t{640} * 240; ++i) ASSERT_EQ(bytes[i], vtof::pattern(ONI_SENSOR_DEPTH, 3, i));
}

TEST_F(Frames, ThatDoNotFitAreThrownAwayAndSaid) {
  const OpenCamera camera(depthOnly());
  ASSERT_EQ(camera.start(), SPHC_OK);
  const auto refused = [&](int index, void (*spoil)(vtof::Frame *), const char *text) {
    vtof::Frame frame = depth(index);
    spoil(&frame);
    ASSERT_TRUE(vtof::emit(0, frame));
    EXPECT_EQ(camera.next(), SPHC_E_IMAGE);
    EXPECT_THAT(camera.message(), HasSubstr(text));
  };
  refused(
      1, [](vtof::Frame *f) { f->width = 319; }, "319 x 240");
  refused(
      2, [](vtof::Frame *f) { f->height = 100000; }, "320 x 100000");
  refused(
      3, [](vtof::Frame *f) { f->width = -320; }, "-320 x 240");
  refused(
      4, [](vtof::Frame *f) { f->format = ONI_PIXEL_FORMAT_SHIFT_9_2; }, "format 102");
  refused(
      5, [](vtof::Frame *f) { f->data_bytes = 320 * 240 * 2 - 1; }, "153599 bytes");
  refused(
      6, [](vtof::Frame *f) { f->stride_bytes = 638; }, "rows of 638");
  refused(
      7, [](vtof::Frame *f) { f->stride_bytes = -640; }, "rows of -640");
  refused(
      8, [](vtof::Frame *f) { f->stride_bytes = INT32_MAX; }, "rows of 2147483647");
  refused(
      9, [](vtof::Frame *f) { f->data_bytes = -1; }, "-1 bytes");
  pass(camera, depth(10));
  EXPECT_EQ(camera.statistics().depth.bad, 9u);
  EXPECT_EQ(camera.statistics().depth.lost, 0u);
}

TEST_F(Frames, ThatAreMissingAreCountedAndLeaveAGap) {
  const OpenCamera camera(depthOnly());
  ASSERT_EQ(camera.start(), SPHC_OK);
  pass(camera, depth(5));
  ASSERT_TRUE(vtof::emit(0, depth(9)));
  sphc_capture capture = {};
  ASSERT_EQ(camera.acquire(&capture), SPHC_OK);
  EXPECT_EQ(capture.sequence, 9u);
  EXPECT_EQ(camera.statistics().depth.lost, 3u);
  EXPECT_EQ(camera.statistics().depth.captured, 2u);
}

TEST_F(Frames, ThatComeTwiceAreGivenOnce) {
  const OpenCamera camera(depthOnly());
  ASSERT_EQ(camera.start(), SPHC_OK);
  pass(camera, depth(1));
  ASSERT_TRUE(vtof::emit(0, depth(1)));
  while (camera.statistics().depth.duplicated == 0) EXPECT_EQ(camera.next(kSoonUs), SPHC_AGAIN);
  pass(camera, depth(2));
  EXPECT_EQ(camera.statistics().depth.duplicated, 1u);
}

TEST_F(Frames, GoOnInTimeWhenTheDevicesClockJumps) {
  for (const uint64_t jumped_us : {uint64_t{10}, uint64_t{1} << 50, UINT64_MAX - 1}) {
    const OpenCamera camera(depthOnly());
    ASSERT_EQ(camera.start(), SPHC_OK);
    sphc_capture before = {}, after = {};
    ASSERT_TRUE(vtof::emit(0, depth(30)));
    ASSERT_EQ(camera.acquire(&before), SPHC_OK);
    ASSERT_TRUE(vtof::emit(0, plainFrame(ONI_SENSOR_DEPTH, 31, jumped_us)));
    EXPECT_EQ(camera.next(), SPHC_E_DEVICE);
    EXPECT_THAT(camera.message(), HasSubstr("clock jumped before depth frame 31"));
    ASSERT_EQ(camera.acquire(&after), SPHC_OK) << camera.message();
    EXPECT_GT(after.time_ns, before.time_ns);
    EXPECT_LT(after.time_ns, before.time_ns + kPatienceUs * int64_t{1000});
    EXPECT_EQ(after.sequence, 31u);
    EXPECT_EQ(camera.statistics().depth.clock_jumps, 1u);
  }
}

TEST_F(Frames, ThatFindNoBufferAreCounted) {
  sphc_openni2_config config = depthOnly();
  config.loan_limit = 2;
  const OpenCamera camera(config);
  ASSERT_EQ(camera.start(), SPHC_OK);
  sphc_capture loans[2] = {};
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(vtof::emit(0, depth(i + 1)));
    ASSERT_EQ(camera.acquire(&loans[i]), SPHC_OK);
  }
  ASSERT_TRUE(vtof::emit(0, depth(3)));
  while (camera.statistics().depth.overrun == 0) EXPECT_EQ(camera.next(), SPHC_E_STATE);
  camera.release(loans[0]);
  sphc_capture capture = {};
  ASSERT_TRUE(vtof::emit(0, depth(4)));
  ASSERT_EQ(camera.acquire(&capture), SPHC_OK);
  EXPECT_EQ(capture.sequence, 4u) << "the gap shows";
  EXPECT_EQ(camera.statistics().depth.overrun, 1u);
}

TEST_F(Frames, WaitForTheOlderOneOfTheOtherStream) {
  sphc_openni2_config config = cameraConfig();
  config.order_wait_us = 1000000;
  const OpenCamera camera(config);
  ASSERT_EQ(camera.start(), SPHC_OK);
  camera.passPair(1);
  // Depth overtakes colour on its way.
  ASSERT_TRUE(vtof::emit(0, plainFrame(ONI_SENSOR_DEPTH, 2, 2 * kFramePeriodUs + 5000)));
  ASSERT_TRUE(vtof::emit(0, plainFrame(ONI_SENSOR_COLOR, 2, 2 * kFramePeriodUs)));
  sphc_capture capture = {};
  ASSERT_EQ(camera.acquire(&capture), SPHC_OK);
  EXPECT_EQ(capture.stream, SPHC_STREAM_COLOR);
  ASSERT_EQ(camera.acquire(&capture), SPHC_OK);
  EXPECT_EQ(capture.stream, SPHC_STREAM_DEPTH);
}

TEST_F(Frames, ThatComeTooLateForTheOrderAreCounted) {
  sphc_openni2_config config = cameraConfig();
  config.order_wait_us = 1;
  const OpenCamera camera(config);
  ASSERT_EQ(camera.start(), SPHC_OK);
  pass(camera, plainFrame(ONI_SENSOR_DEPTH, 2, 2 * kFramePeriodUs));
  ASSERT_TRUE(vtof::emit(0, plainFrame(ONI_SENSOR_COLOR, 1, kFramePeriodUs)));
  ASSERT_TRUE(vtof::emit(0, plainFrame(ONI_SENSOR_DEPTH, 3, 3 * kFramePeriodUs)));
  ASSERT_EQ(camera.next(), SPHC_OK) << camera.message();
  while (camera.statistics().color.late == 0) EXPECT_EQ(camera.next(kSoonUs), SPHC_AGAIN);
  EXPECT_EQ(camera.statistics().color.captured, 0u);
}

TEST_F(Frames, ThatStayAwayAreAFailureSaidOnce) {
  sphc_openni2_config config = depthOnly();
  config.stall_us = 1000;
  const OpenCamera camera(config);
  ASSERT_EQ(camera.start(), SPHC_OK);
  EXPECT_EQ(camera.next(), SPHC_E_DEVICE);
  EXPECT_THAT(camera.message(), HasSubstr("no depth frame for"));
  EXPECT_EQ(camera.next(kSoonUs), SPHC_AGAIN);
  EXPECT_EQ(camera.statistics().depth.stalls, 1u);
  ASSERT_TRUE(vtof::emit(0, depth(1)));
  sphc_status status = camera.next();
  while (status == SPHC_E_DEVICE) status = camera.next();  // the next silence may be noticed before this frame
  EXPECT_EQ(status, SPHC_OK);
}

TEST_F(Frames, OfEqualNumberComeInPairsWhenSynchronised) {
  sphc_openni2_config config = cameraConfig();
  config.frame_sync = 1;
  const OpenCamera camera(config);
  ASSERT_EQ(camera.status(), SPHC_OK) << camera.openMessage();
  EXPECT_EQ(camera.info().frame_sync, 1u);
  ASSERT_EQ(camera.start(), SPHC_OK);
  EXPECT_EQ(vtof::syncedStreams(), 2);
  camera.passPair(1);
  ASSERT_TRUE(vtof::emit(0, plainFrame(ONI_SENSOR_COLOR, 2, 2 * kFramePeriodUs)));  // its depth is lost
  camera.passPair(3);
  const sphc_openni2_statistics statistics = camera.statistics();
  EXPECT_EQ(statistics.color.captured, 2u);
  EXPECT_EQ(statistics.color.lost, 1u) << "colour without depth is dropped by OpenNI2, and shows";
  EXPECT_EQ(statistics.depth.lost, 1u);
  camera.stop();
  ASSERT_EQ(camera.start(), SPHC_OK);
  camera.passPair(4);
}

TEST_F(Frames, AreNotSynchronisedWhereTheDeviceRefuses) {
  vtof::Faults faults = {};
  faults.refuses_sync = true;
  vtof::setFaults(0, faults);
  sphc_openni2_config config = cameraConfig();
  config.frame_sync = 1;
  const OpenCamera camera(config);
  EXPECT_EQ(camera.start(), SPHC_E_UNSUPPORTED);
  EXPECT_THAT(camera.message(), HasSubstr("refuses to synchronise"));
  EXPECT_EQ(camera.next(kSoonUs), SPHC_E_STATE);
}

TEST_F(Frames, OfTheDevicesOwnFailuresAreSaid) {
  const OpenCamera camera;
  ASSERT_EQ(camera.start(), SPHC_OK);
  vtof::changeState(0, ONI_DEVICE_STATE_ERROR);
  EXPECT_EQ(camera.next(), SPHC_E_DEVICE);
  EXPECT_THAT(camera.message(), HasSubstr("reports a failure"));
  vtof::changeState(0, ONI_DEVICE_STATE_NOT_READY);
  EXPECT_EQ(camera.next(), SPHC_E_DEVICE);
  camera.passPair(1);
}

TEST_F(Frames, StartAgainAfterAStartThatFailed) {
  const OpenCamera camera;
  vtof::Faults faults = {};
  faults.does_not_start = true;
  vtof::setFaults(0, faults);
  EXPECT_EQ(camera.start(), SPHC_E_DEVICE);
  EXPECT_THAT(camera.message(), HasSubstr("does not start"));
  EXPECT_EQ(camera.next(kSoonUs), SPHC_E_STATE);
  vtof::setFaults(0, {});
  ASSERT_EQ(camera.start(), SPHC_OK) << camera.message();
  camera.passPair(1);
}

}  // namespace

}  // namespace sphc::contract
