// Amplitudes of depth images: into an MCAP file and out of it again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "host/recording/mcap/writer.h"
#include "host/recording/recorder.h"
#include "tests/support/temp_folder.h"
#include "tiny_mcap.h"

namespace sphc::contract {

namespace {

using ::testing::HasSubstr;

class RecordedAmplitude : public ::testing::Test {
 protected:
  std::string file() const { return temp_ / "walk.mcap"; }

  // The frame that is read by its index, whose amplitudes are expected.
  void expectAmplitude(const OpenReplay &replay, uint32_t i, const std::vector<uint16_t> &expected) {
    sphc_localizer_frame frame;
    sphc_message message{};
    ASSERT_EQ(sphc_replay_read_frame(replay.get(), i, &frame, &message), SPHC_OK) << message.text;
    if (expected.empty()) {
      EXPECT_EQ(frame.amplitude.data, nullptr);
      return;
    }
    ASSERT_NE(frame.amplitude.data, nullptr);
    EXPECT_EQ(frame.amplitude.format, SPHC_FORMAT_GRAY16);
    EXPECT_EQ(frame.amplitude.width, kDepthWidth);
    EXPECT_EQ(frame.amplitude.height, kDepthHeight);
    EXPECT_EQ(frame.amplitude.stride_bytes, kDepthWidth * 2);
    EXPECT_EQ(std::memcmp(frame.amplitude.data, expected.data(), expected.size() * 2), 0);
    const TinyImages images(i);
    EXPECT_EQ(std::memcmp(frame.depth.data, images.depth.data(), images.depth.size() * 2), 0);
  }

  // A file of one frame with amplitudes as they are given, whatever they are.
  void writeForged(uint32_t sequence, int64_t time_ns, const sphc_image &amplitude) {
    using namespace recording;
    McapWriter writer(file(), 1 << 16, 1 << 16);
    Bytes head;
    putSchemasAndChannels(head, {Kind::kColorImage, Kind::kDepthImage, Kind::kAmplitudeImage});
    writer.begin(head);
    const TinyImages images(0);
    putImageMessage(writer.beginMessage(Kind::kColorImage, 0, 1000), 1000, images.colorImage());
    writer.endMessage();
    putImageMessage(writer.beginMessage(Kind::kAmplitudeImage, sequence, time_ns), time_ns, amplitude);
    writer.endMessage();
    putImageMessage(writer.beginMessage(Kind::kDepthImage, 0, 1001), 1001, images.depthImage());
    writer.endMessage();
    writer.finish({});
  }
  sphc_status readForged(std::string *why) {
    const sphc_rig rig = tinyCalibration();
    const std::string calibration = temp_ / "calibration.json";
    EXPECT_EQ(sphc_calibration_write(calibration.c_str(), &rig, nullptr), SPHC_OK);
    const OpenReplay replay(file(), calibration.c_str());
    EXPECT_EQ(replay.status(), SPHC_OK) << replay.message();
    sphc_localizer_frame frame;
    sphc_message message{};
    const sphc_status status = sphc_replay_read_frame(replay.get(), 0, &frame, &message);
    if (status == SPHC_OK) has_amplitude_ = frame.amplitude.data != nullptr;
    *why = message.text;
    return status;
  }

  test::TempFolder temp_;
  sphc_recorder_config config_ = recorderConfig();
  bool has_amplitude_ = false;
};

TEST_F(RecordedAmplitude, ComesBackWithItsDepth) {
  for (const sphc_depth_codec codec : {SPHC_DEPTH_RAW, SPHC_DEPTH_RVL, SPHC_DEPTH_ZSTD}) {
    config_.depth_codec = codec;
    const std::string path = temp_ / std::to_string(codec);
    OpenRecorder recorder(path, config_);
    for (uint32_t i = 0; i < 4; ++i) {
      const TinyImages images(i);
      const std::vector<uint16_t> amplitude = tinyAmplitude(i);
      const sphc_capture color = tinyCapture(i, SPHC_STREAM_COLOR, images);
      sphc_capture depth = tinyCapture(i, SPHC_STREAM_DEPTH, images);
      if (i != 2) depth.amplitude = amplitudeImage(amplitude);
      ASSERT_EQ(sphc_recorder_add(recorder.get(), &color, nullptr), SPHC_OK);
      ASSERT_EQ(sphc_recorder_add(recorder.get(), &depth, nullptr), SPHC_OK);
    }
    ASSERT_EQ(recorder.close(), SPHC_OK);
    const OpenReplay replay(path);
    for (const uint32_t i : {0u, 3u, 2u, 1u})
      expectAmplitude(replay, i, i == 2 ? std::vector<uint16_t>() : tinyAmplitude(i));
    // As a source.
    sphc_source source;
    ASSERT_EQ(sphc_replay_source(replay.get(), &source), SPHC_OK);
    ASSERT_EQ(source.start(source.self), SPHC_OK);
    for (uint32_t n = 0; n < 8; ++n) {
      sphc_capture capture{};
      capture.struct_size = sizeof capture;
      ASSERT_EQ(source.acquire(source.self, 0, &capture), SPHC_OK) << source.message(source.self);
      const bool has_one = capture.stream == SPHC_STREAM_DEPTH && capture.sequence != 2;
      ASSERT_EQ(capture.amplitude.data != nullptr, has_one) << n;
      if (has_one) {
        const std::vector<uint16_t> expected = tinyAmplitude(capture.sequence);
        const TinyImages images(capture.sequence);
        EXPECT_EQ(std::memcmp(capture.amplitude.data, expected.data(), expected.size() * 2), 0);
        EXPECT_EQ(std::memcmp(capture.image.data, images.depth.data(), images.depth.size() * 2), 0);
      }
      source.release(source.self, &capture);
    }
  }
}

// Numbers stay what they are, in whatever format and stride they come.
TEST_F(RecordedAmplitude, IsTakenInEveryFormat) {
  const TinyImages images(0);
  for (const sphc_format format : {SPHC_FORMAT_GRAY8, SPHC_FORMAT_GRAY10, SPHC_FORMAT_GRAY12, SPHC_FORMAT_GRAY16}) {
    const uint32_t bytes = sphc_format_bytes(format), stride = kDepthWidth * bytes + 5;  // of no alignment
    std::vector<uint8_t> rows(stride * kDepthHeight);
    std::vector<uint16_t> expected;
    for (uint32_t y = 0; y < kDepthHeight; ++y)
      for (uint32_t x = 0; x < kDepthWidth; ++x) {
        const auto value = static_cast<uint16_t>((7 * y + x) & (bytes == 1 ? 0xFF : 0x3FF));
        uint8_t *at = &rows[y * stride + x * bytes];
        at[0] = static_cast<uint8_t>(value);
        if (bytes == 2) at[1] = static_cast<uint8_t>(value >> 8);
        expected.push_back(value);
      }
    const std::string path = temp_ / std::to_string(format);
    OpenRecorder recorder(path, config_);
    const sphc_capture color = tinyCapture(0, SPHC_STREAM_COLOR, images);
    sphc_capture depth = tinyCapture(0, SPHC_STREAM_DEPTH, images);
    depth.amplitude = {rows.data(), kDepthWidth, kDepthHeight, stride, format};
    ASSERT_EQ(sphc_recorder_add(recorder.get(), &color, nullptr), SPHC_OK);
    ASSERT_EQ(sphc_recorder_add(recorder.get(), &depth, nullptr), SPHC_OK);
    ASSERT_EQ(recorder.close(), SPHC_OK);
    expectAmplitude(OpenReplay(path), 0, expected);
  }
}

TEST_F(RecordedAmplitude, ThatDoesNotFitIsRefused) {
  OpenRecorder recorder(file(), config_);
  const TinyImages images(0);
  const std::vector<uint16_t> amplitude = tinyAmplitude(0);
  sphc_message message{};
  const auto refuse = [&](const sphc_capture &capture, const char *words) {
    EXPECT_EQ(sphc_recorder_add(recorder.get(), &capture, &message), SPHC_E_IMAGE);
    EXPECT_THAT(message.text, HasSubstr(words));
  };
  sphc_capture good = tinyCapture(0, SPHC_STREAM_DEPTH, images);
  good.amplitude = amplitudeImage(amplitude);
  sphc_capture bad = good;
  bad.amplitude.format = SPHC_FORMAT_DEPTH16;
  refuse(bad, "give GRAY8");
  bad.amplitude.format = 0;
  refuse(bad, "give GRAY8");
  bad = good;
  bad.amplitude.height -= 1;
  refuse(bad, "40 x 23");
  bad = good;
  bad.amplitude.stride_bytes -= 1;
  refuse(bad, "less than a row");
  bad = tinyCapture(0, SPHC_STREAM_COLOR, images);
  bad.amplitude = good.amplitude;
  refuse(bad, "colour capture");
  EXPECT_EQ(sphc_recorder_add(recorder.get(), &good, &message), SPHC_OK);
}

// In a file from outside.
TEST_F(RecordedAmplitude, BelongsToTheDepthOfItsTimeAndNumber) {
  const std::vector<uint16_t> amplitude = tinyAmplitude(0);
  std::string why;
  for (const auto &[sequence, time_ns] : {std::pair{0u, 1001}, {1u, 1001}, {0u, 1000}}) {
    writeForged(sequence, time_ns, amplitudeImage(amplitude));
    EXPECT_EQ(readForged(&why), SPHC_OK) << why;
    EXPECT_EQ(has_amplitude_, sequence == 0 && time_ns == 1001);
    std::remove(file().c_str());
  }
}

TEST_F(RecordedAmplitude, ThatDoesNotFitTheCameraIsNotRead) {
  const std::vector<uint16_t> amplitude = tinyAmplitude(0);
  const auto refuse = [&](const sphc_image &image, sphc_status status, const char *words) {
    writeForged(0, 1001, image);
    std::string why;
    EXPECT_EQ(readForged(&why), status);
    EXPECT_THAT(why, HasSubstr("its amplitudes"));
    EXPECT_THAT(why, HasSubstr(words));
    std::remove(file().c_str());
  };
  sphc_image image = amplitudeImage(amplitude);
  image.width -= 1;
  refuse(image, SPHC_E_IMAGE, "39 x 24");
  image = amplitudeImage(amplitude);
  image.format = SPHC_FORMAT_DEPTH16;
  refuse(image, SPHC_E_DEVICE, "encoding");
  image.format = SPHC_FORMAT_GRAY8;
  refuse(image, SPHC_E_DEVICE, "encoding");
}

// A colour image is never one of 16 bits.
TEST_F(RecordedAmplitude, ItsEncodingIsNoColour) {
  using namespace recording;
  McapWriter writer(file(), 1 << 16, 1 << 16);
  Bytes head;
  putSchemasAndChannels(head, {Kind::kColorImage, Kind::kDepthImage});
  writer.begin(head);
  const TinyImages images(0);
  const std::vector<uint16_t> wide(kColorWidth * kColorHeight);
  const sphc_image sixteen = {wide.data(), kColorWidth, kColorHeight, kColorWidth * 2, SPHC_FORMAT_GRAY16};
  putImageMessage(writer.beginMessage(Kind::kColorImage, 0, 1000), 1000, sixteen);
  writer.endMessage();
  putImageMessage(writer.beginMessage(Kind::kDepthImage, 0, 1001), 1001, images.depthImage());
  writer.endMessage();
  writer.finish({});
  std::string why;
  EXPECT_EQ(readForged(&why), SPHC_E_DEVICE);
  EXPECT_THAT(why, HasSubstr("is of the encoding \"mono16\" in place of bgr8, rgb8 or mono8"));
}

}  // namespace

}  // namespace sphc::contract
