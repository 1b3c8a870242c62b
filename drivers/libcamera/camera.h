// An open camera as a source: frames in, converted captures on loan out.
#pragma once

#include <memory>
#include <vector>

#include "drivers/pixels/mjpeg.h"
#include "frame_time.h"
#include "setup.h"
#include "spherecloud/spherecloud_capture.h"

namespace sphc::libcamera {

class Camera {
 public:
  Camera(const sphc_libcamera_plugin &plugin, const sphc_libcamera_config &config)
      : plugin_(plugin), config_(config) {}
  ~Camera();
  Camera(const Camera &) = delete;
  Camera &operator=(const Camera &) = delete;

  sphc_status open(const char *id, sphc_message *message);
  void describe(sphc_libcamera_info *info) const;

  sphc_status start();
  sphc_status acquire(uint32_t timeout_us, sphc_capture *capture);
  void release(const sphc_capture &capture);
  void stop();
  const char *message() const { return message_.text; }
  uint32_t loanLimit() const { return config_.loan_limit; }

 private:
  struct Slot {          // one image of ours
    uint64_t token = 0;  // of its loan; 0 when free
    std::unique_ptr<uint8_t[]> pixels;
  };

  pixels::OutImage imageOf(const Slot &slot) const;
  sphc_status refuse(const sphc_libcamera_frame &frame);
  sphc_status convertInto(const Slot &slot, const sphc_libcamera_frame &frame);
  void count(uint32_t sequence);

  const sphc_libcamera_plugin &plugin_;
  const sphc_libcamera_config config_;  // its strings are not used after open
  sphc_libcamera_device *device_ = nullptr;
  sphc_libcamera_name name_ = {};
  Setup setup_ = {};
  std::vector<sphc_libcamera_buffer> buffers_;
  std::vector<Slot> slots_;
  pixels::MjpegDecoder decoder_;

  bool running_ = false;
  uint32_t set_exposure_us_ = 0;  // by the config; 0: by the camera itself, for all that is known
  bool any_ = false;              // a frame since start
  uint32_t sequence_ = 0;         // of the last one
  int64_t last_ns_ = INT64_MIN;
  uint64_t last_token_ = 0;  // counts on through restarts
  uint64_t lost_ = 0, refused_ = 0, without_time_ = 0;
  FrameClock clock_;
  sphc_message message_ = {};
};

}  // namespace sphc::libcamera
