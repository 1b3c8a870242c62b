// A camera of a fake kernel, opened, and short words for what tests do with it.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "drivers/v4l2/open.h"
#include "spherecloud/spherecloud_capture.h"
#include "tests/support/fake_v4l2.h"

namespace sphc::v4l2 {

constexpr uint32_t kWidth = 64, kHeight = 48;
constexpr int64_t kPeriodNs = 1000000000 / 30;

inline sphc_v4l2_config configFor(sphc_stream stream) {
  sphc_v4l2_config config;
  sphc_v4l2_config_init(&config, sizeof config);
  config.stream = stream;
  config.width = kWidth;
  config.height = kHeight;
  return config;
}

inline test::FakeCamera depthCamera() { return test::FakeCamera({{V4L2_PIX_FMT_Z16, kWidth, kHeight, 30}}); }
inline test::FakeCamera colorCamera() { return test::FakeCamera({{V4L2_PIX_FMT_YUYV, kWidth, kHeight, 30}}); }

class OpenedCamera {
 public:
  OpenedCamera(test::FakeKernel &kernel, const sphc_v4l2_config &config, const char *name = "/dev/video0") {
    status = openCamera(kernel.syscalls(), name, &config, &handle, &message);
    if (handle) sphc_v4l2_source(handle, &source_);
  }
  ~OpenedCamera() { sphc_v4l2_close(&handle); }
  OpenedCamera(const OpenedCamera &) = delete;

  sphc_status start() { return source_.start(source_.self); }
  sphc_status acquire(sphc_capture *capture, uint32_t timeout_us = 100000) {
    *capture = {};
    capture->struct_size = sizeof *capture;
    return source_.acquire(source_.self, timeout_us, capture);
  }
  // A capture that must come.
  sphc_capture take() {
    sphc_capture capture;
    EXPECT_EQ(acquire(&capture), SPHC_OK) << text();
    return capture;
  }
  void release(const sphc_capture &capture) { source_.release(source_.self, &capture); }
  void stop() { source_.stop(source_.self); }
  const char *text() const { return source_.message(source_.self); }
  sphc_v4l2_stats stats() const {
    sphc_v4l2_stats stats = {};
    stats.struct_size = sizeof stats;
    EXPECT_EQ(sphc_v4l2_get_stats(handle, &stats), SPHC_OK);
    return stats;
  }
  sphc_v4l2_mode mode() const {
    sphc_v4l2_mode mode = {};
    mode.struct_size = sizeof mode;
    EXPECT_EQ(sphc_v4l2_get_mode(handle, &mode), SPHC_OK);
    return mode;
  }

  sphc_v4l2 *handle = nullptr;
  sphc_status status;
  sphc_message message = {};

 private:
  sphc_source source_ = {};
};

// One camera at /dev/video0, opened and started.
struct RunningCamera {
  explicit RunningCamera(test::FakeCamera fake, sphc_v4l2_config config)
      : camera(kernel.plugIn(0, std::move(fake))), opened(kernel, config) {
    EXPECT_EQ(opened.status, SPHC_OK) << opened.message.text;
    if (opened.status == SPHC_OK) {
      EXPECT_EQ(opened.start(), SPHC_OK) << opened.text();
    }
  }

  test::FakeKernel kernel;
  std::shared_ptr<test::FakeCamera> camera;
  OpenedCamera opened;
};

}  // namespace sphc::v4l2
