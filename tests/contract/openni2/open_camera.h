// An opened camera that closes itself, and what tests ask of it.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "drivers/openni2/openni2.h"
#include "spherecloud/spherecloud_capture.h"
#include "tests/support/openni2/virtual_tof.h"

namespace sphc::contract {

constexpr uint32_t kSoonUs = 1000;
constexpr uint32_t kPatienceUs = 10000000;  // for what must come, however slow the machine

inline sphc_openni2_config cameraConfig() {
  sphc_openni2_config config;
  sphc_openni2_config_init(&config, sizeof config);
  config.stall_us = 60000000;  // tests of stalls set it
  return config;
}

class OpenCamera {
 public:
  explicit OpenCamera(const sphc_openni2_config &config = cameraConfig(), const char *uri = vtof::uri(0)) {
    status_ = sphc_openni2_open(uri, &config, &camera_, &message_);
    if (camera_) sphc_openni2_source(camera_, &source_);
  }
  ~OpenCamera() { sphc_openni2_close(&camera_); }
  OpenCamera(const OpenCamera &) = delete;
  OpenCamera &operator=(const OpenCamera &) = delete;

  sphc_openni2 *get() const { return camera_; }
  sphc_status status() const { return status_; }
  std::string openMessage() const { return message_.text; }
  std::string message() const { return source_.message(source_.self); }

  sphc_status start() const { return source_.start(source_.self); }
  void stop() const { source_.stop(source_.self); }
  void release(const sphc_capture &capture) const { source_.release(source_.self, &capture); }
  sphc_status acquire(sphc_capture *capture, uint32_t timeout_us = kPatienceUs) const {
    capture->struct_size = sizeof *capture;
    return source_.acquire(source_.self, timeout_us, capture);
  }
  // The status of one acquire whose capture, if there is one, goes back.
  sphc_status next(uint32_t timeout_us = kPatienceUs) const {
    sphc_capture capture = {};
    const sphc_status status = acquire(&capture, timeout_us);
    if (status == SPHC_OK) release(capture);
    return status;
  }
  // Emits a pair, and takes it.
  void passPair(int index) const {
    vtof::emitPair(0, index);
    for (int i = 0; i < 2; ++i) ASSERT_EQ(next(), SPHC_OK) << message();
  }

  sphc_openni2_info info() const {
    sphc_openni2_info info = {};
    info.struct_size = sizeof info;
    EXPECT_EQ(sphc_openni2_get_info(camera_, &info), SPHC_OK);
    return info;
  }
  sphc_openni2_statistics statistics() const {
    sphc_openni2_statistics statistics = {};
    statistics.struct_size = sizeof statistics;
    EXPECT_EQ(sphc_openni2_get_statistics(camera_, &statistics), SPHC_OK);
    return statistics;
  }

 private:
  sphc_openni2 *camera_ = nullptr;
  sphc_source source_ = {};
  sphc_status status_;
  sphc_message message_ = {};
};

// Virtual cameras as new, before and after.
class VirtualCameras : public ::testing::Test {
 protected:
  void SetUp() override { vtof::reset(); }
  void TearDown() override { vtof::reset(); }
};

// A frame of the mode's size.
inline vtof::Frame plainFrame(OniSensorType sensor, int index, uint64_t timestamp_us) {
  vtof::Frame frame = {};
  frame.sensor = sensor;
  frame.index = index;
  frame.timestamp_us = timestamp_us;
  return frame;
}

}  // namespace sphc::contract
