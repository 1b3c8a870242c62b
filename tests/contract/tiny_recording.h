// A small recording of known content, made with the recording writer.
#pragma once

#include <gtest/gtest.h>
#include <spherecloud/spherecloud.hpp>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "drivers/replay/replay.h"
#include "host/recording/recording_writer.h"

namespace sphc::contract {

constexpr uint32_t kColorWidth = 48;
constexpr uint32_t kColorHeight = 32;
constexpr uint32_t kDepthWidth = 40;
constexpr uint32_t kDepthHeight = 24;
constexpr int64_t kPeriodNs = 10000000;  // 100 Hz, so that real-time tests are short
constexpr int64_t kDepthLagNs = 1000003;
constexpr int64_t kFirstNs = 1305031102175304123;  // more digits than a double holds

inline sphc_rig tinyCalibration() {
  sphc_rig calibration;
  sphc_rig_init(&calibration);
  calibration.color_camera = {SPHC_CAMERA_PINHOLE, kColorWidth, kColorHeight, 4, {50.25, 50.125, 24, 16}};
  calibration.depth_camera = {
      SPHC_CAMERA_BROWN5, kDepthWidth, kDepthHeight, 9, {40, 41, 20, 12, 0.1, -0.01, 0, 0, 1e-3}};
  calibration.color_from_depth = {{std::cos(0.05), 0, std::sin(0.05), 0}, {0.02, -0.01, 0.003}};
  return calibration;
}

// Colour as blue, green, red of pixel (x, y) of frame i; depth likewise.
inline uint8_t tinyColor(uint32_t i, uint32_t x, uint32_t y, uint32_t channel) {
  return static_cast<uint8_t>(7 * i + 3 * x + 5 * y + 60 * channel);
}
inline uint16_t tinyDepth(uint32_t i, uint32_t x, uint32_t y) {
  return static_cast<uint16_t>(1000 * i + 30 * y + x);
}

inline sphc_rigid tinyPose(uint32_t i) {
  const double half = 0.01 * i;
  return {{std::cos(half), 0, 0, std::sin(half)}, {0.1 * i, 1.0 / 3.0, -2}};
}

struct TinyImages {
  explicit TinyImages(uint32_t i) : color(kColorWidth * kColorHeight * 3), depth(kDepthWidth * kDepthHeight) {
    for (uint32_t y = 0; y < kColorHeight; ++y)
      for (uint32_t x = 0; x < kColorWidth; ++x)
        for (uint32_t c = 0; c < 3; ++c) color[(y * kColorWidth + x) * 3 + c] = tinyColor(i, x, y, c);
    for (uint32_t y = 0; y < kDepthHeight; ++y)
      for (uint32_t x = 0; x < kDepthWidth; ++x) depth[y * kDepthWidth + x] = tinyDepth(i, x, y);
  }

  sphc_image colorImage() const {
    return {color.data(), kColorWidth, kColorHeight, kColorWidth * 3, SPHC_FORMAT_BGR8};
  }
  sphc_image depthImage() const {
    return {depth.data(), kDepthWidth, kDepthHeight, kDepthWidth * 2, SPHC_FORMAT_DEPTH16};
  }

  std::vector<uint8_t> color;
  std::vector<uint16_t> depth;
};

inline sphc_localizer_frame tinyFrame(uint32_t i, const TinyImages &images) {
  const int64_t time_ns = kFirstNs + i * kPeriodNs;
  return spherecloud::frame(i, time_ns, images.colorImage(), time_ns + kDepthLagNs, images.depthImage());
}

inline void writeTinyRecording(const std::string &folder, uint32_t frames) {
  const sphc_rig calibration = tinyCalibration();
  sphc_recording_writer *writer = nullptr;
  sphc_message message{};
  ASSERT_EQ(sphc_recording_create(folder.c_str(), &calibration, &writer, &message), SPHC_OK) << message.text;
  for (uint32_t i = 0; i < frames; ++i) {
    const TinyImages images(i);
    const sphc_localizer_frame frame = tinyFrame(i, images);
    const sphc_rigid pose = tinyPose(i);
    EXPECT_EQ(sphc_recording_add_frame(writer, &frame, &message), SPHC_OK) << message.text;
    EXPECT_EQ(sphc_recording_add_pose(writer, frame.color_time_ns, &pose, &message), SPHC_OK) << message.text;
  }
  EXPECT_EQ(sphc_recording_close(&writer, &message), SPHC_OK) << message.text;
}

// An opened replay that closes itself.
class OpenReplay {
 public:
  explicit OpenReplay(const std::string &folder, const char *calibration = nullptr,
                      const sphc_replay_config *config = nullptr) {
    status_ = sphc_replay_open(folder.c_str(), calibration, config, &replay_, &message_);
  }
  ~OpenReplay() { sphc_replay_close(&replay_); }
  OpenReplay(const OpenReplay &) = delete;
  OpenReplay &operator=(const OpenReplay &) = delete;

  sphc_replay *get() const { return replay_; }
  sphc_status status() const { return status_; }
  std::string message() const { return message_.text; }

 private:
  sphc_replay *replay_ = nullptr;
  sphc_status status_;
  sphc_message message_ = {};
};

inline sphc_replay_info infoOf(const OpenReplay &replay) {
  sphc_replay_info info{};
  info.struct_size = sizeof info;
  EXPECT_EQ(sphc_replay_get_info(replay.get(), &info), SPHC_OK);
  return info;
}

inline sphc_replay_config replayConfig() {
  sphc_replay_config config;
  sphc_replay_config_init(&config, sizeof config);
  return config;
}

}  // namespace sphc::contract
