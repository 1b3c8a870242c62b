// The small recording of tiny_recording.h in one file, made with the recorder.
#pragma once

#include "host/recording/recorder.h"
#include "spherecloud/spherecloud_capture.h"
#include "tiny_recording.h"

namespace sphc::contract {

inline sphc_recorder_config recorderConfig() {
  sphc_recorder_config config;
  sphc_recorder_config_init(&config, sizeof config);
  config.wait_us = 60000000;
  return config;
}

// With something in every field.
inline sphc_capture tinyCapture(uint32_t i, sphc_stream stream, const TinyImages &images) {
  const bool is_color = stream == SPHC_STREAM_COLOR;
  sphc_capture capture{};
  capture.struct_size = sizeof capture;
  capture.stream = stream;
  capture.time_ns = kFirstNs + i * kPeriodNs + (is_color ? 0 : kDepthLagNs);
  capture.sequence = i;
  capture.image = is_color ? images.colorImage() : images.depthImage();
  capture.arrival_ns = 123456789000 + i;
  capture.exposure_us = 8000 + i;
  capture.time_sigma_us = is_color ? 40 : 50;
  capture.clock = SPHC_CLOCK_MONOTONIC;
  capture.time_point = is_color ? SPHC_TIME_START : SPHC_TIME_ARRIVAL;
  return capture;
}

inline std::vector<uint16_t> tinyAmplitude(uint32_t i) {
  std::vector<uint16_t> amplitude;
  for (uint32_t y = 0; y < kDepthHeight; ++y)
    for (uint32_t x = 0; x < kDepthWidth; ++x)
      amplitude.push_back(static_cast<uint16_t>(x % 7 == 0 ? 0 : 60000 + 300 * i + 17 * y * x));
  return amplitude;
}
inline sphc_image amplitudeImage(const std::vector<uint16_t> &amplitude) {
  return {amplitude.data(), kDepthWidth, kDepthHeight, kDepthWidth * 2, SPHC_FORMAT_GRAY16};
}

// A recorder that closes itself.
class OpenRecorder {
 public:
  OpenRecorder(const std::string &path, const sphc_recorder_config &config) {
    const sphc_rig calibration = tinyCalibration();
    status_ = sphc_recorder_open(path.c_str(), &calibration, &config, &recorder_, &message_);
  }
  ~OpenRecorder() { close(); }
  OpenRecorder(const OpenRecorder &) = delete;
  OpenRecorder &operator=(const OpenRecorder &) = delete;

  sphc_recorder *get() const { return recorder_; }
  sphc_status status() const { return status_; }
  sphc_status close() { return sphc_recorder_close(&recorder_, &message_); }
  std::string message() const { return message_.text; }

 private:
  sphc_recorder *recorder_ = nullptr;
  sphc_status status_;
  sphc_message message_ = {};
};

inline void addTinyFrames(sphc_recorder *recorder, uint32_t frames, bool with_amplitudes = false) {
  sphc_message message{};
  for (uint32_t i = 0; i < frames; ++i) {
    const TinyImages images(i);
    const sphc_capture color = tinyCapture(i, SPHC_STREAM_COLOR, images);
    const std::vector<uint16_t> amplitude = tinyAmplitude(i);
    sphc_capture depth = tinyCapture(i, SPHC_STREAM_DEPTH, images);
    if (with_amplitudes) depth.amplitude = amplitudeImage(amplitude);
    const sphc_rigid pose = tinyPose(i);
    EXPECT_EQ(sphc_recorder_add(recorder, &color, &message), SPHC_OK) << message.text;
    EXPECT_EQ(sphc_recorder_add(recorder, &depth, &message), SPHC_OK) << message.text;
    EXPECT_EQ(sphc_recorder_add_pose(recorder, color.time_ns, &pose, &message), SPHC_OK) << message.text;
  }
}

inline void writeTinyMcap(const std::string &path, uint32_t frames, const sphc_recorder_config &config,
                          bool with_amplitudes = false) {
  OpenRecorder recorder(path, config);
  ASSERT_EQ(recorder.status(), SPHC_OK) << recorder.message();
  addTinyFrames(recorder.get(), frames, with_amplitudes);
  EXPECT_EQ(recorder.close(), SPHC_OK) << recorder.message();
}

// The chunks of an MCAP file, found by a second, independent reader.
struct ChunkSpan {
  size_t start, end;
  uint32_t color, depth;  // images in it
};
inline std::vector<ChunkSpan> chunksOf(const std::string &file) {
  const auto number = [&file](size_t at, size_t bytes) {
    uint64_t value = 0;
    for (size_t i = bytes; i-- > 0;) value = value << 8 | static_cast<uint8_t>(file[at + i]);
    return value;
  };
  std::vector<ChunkSpan> chunks;
  for (size_t at = 8; file[at] != 0x0F; at += 9 + number(at + 1, 8)) {
    if (file[at] != 0x06) continue;
    ChunkSpan chunk{at, at + 9 + number(at + 1, 8), 0, 0};
    for (size_t inner = at + 9 + 40; inner < chunk.end; inner += 9 + number(inner + 1, 8)) {
      const uint64_t channel = number(inner + 9, 2);
      if (channel == 1 || channel == 2) ++chunk.color;
      if (channel >= 3 && channel <= 5) ++chunk.depth;
    }
    chunks.push_back(chunk);
  }
  return chunks;
}

}  // namespace sphc::contract
