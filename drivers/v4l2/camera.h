// An open camera: the mode agreed on, the buffers, and the source with its book of loans.
#pragma once

#include <memory>

#include "buffer_ring.h"
#include "capability.h"
#include "drivers/pixels/mjpeg.h"
#include "frame_clock.h"
#include "frame_counter.h"
#include "negotiate.h"
#include "spherecloud/spherecloud_capture.h"
#include "v4l2.h"

namespace sphc::v4l2 {

class Camera {
 public:
  explicit Camera(const Syscalls &syscalls) : node_(syscalls), ring_(node_) {}

  // `config` is complete: checked, stream and format set.
  sphc_status open(const char *path, const sphc_v4l2_config &config, sphc_message *message);

  sphc_status start();
  sphc_status acquire(uint32_t timeout_us, sphc_capture *capture);
  void release(const sphc_capture &capture);
  void stop();
  const char *message() const { return message_.text; }

  const Node &node() const { return node_; }
  uint32_t loanLimit() const { return config_.loan_limit; }
  void getMode(sphc_v4l2_mode *mode) const;
  const sphc_v4l2_stats &stats() const { return stats_; }
  sphc_status dmabuf(const sphc_capture &capture, int32_t *fd) const;

 private:
  struct Loan {
    uint64_t token;  // 0 when free
    const void *data;
    uint32_t buffer;  // of the kernel; kNoBuffer when the image was converted
    std::unique_ptr<uint8_t[]> pixels;
  };
  static constexpr uint32_t kNoBuffer = UINT32_MAX;

  sphc_status fail(sphc_status status, const char *text);
  sphc_status failCall(const char *call, int error);
  sphc_status makeSlots(sphc_message *message);
  Loan *freeLoan();
  const Loan *findLoan(const sphc_capture &capture) const;

  sphc_status nextFilled(int64_t deadline_ns, FilledBuffer *filled);
  sphc_status waitForFrame(int64_t deadline_ns);
  sphc_status takeNews();
  bool hasStreamEnded() const;
  sphc_status checkAlive();
  // False: the frame is no good; it was counted.
  bool takeFrame(const FilledBuffer &filled, Loan *loan, sphc_capture *capture);
  // Steps of it; each fills its part of the capture.
  bool countFrame(const FilledBuffer &filled, sphc_capture *capture);
  bool stampTime(const FilledBuffer &filled, int64_t arrival_ns, sphc_capture *capture);
  bool isWhole(const FilledBuffer &filled);
  bool fillImage(const FilledBuffer &filled, const Loan &loan, sphc_image *image);
  bool convertInto(const FilledBuffer &filled, const pixels::OutImage &out);
  void readExposure();

  Node node_;
  BufferRing ring_;  // after the node: unmade before it is closed
  sphc_v4l2_config config_ = {};
  Capability capability_ = {};
  Mode mode_ = {};
  bool is_zero_copy_ = false;
  pixels::MjpegDecoder decoder_;
  Loan loans_[SPHC_V4L2_MAX_BUFFERS] = {};
  uint32_t slot_stride_bytes_ = 0;

  bool is_running_ = false;
  sphc_message loss_ = {};   // why the device is lost, for good; empty while it is not
  uint64_t last_token_ = 0;  // counts through restarts, so that an old loan is never taken for a new one
  FrameCounter counter_;
  FrameClock clock_;
  sphc_v4l2_stats stats_ = {};
  sphc_message message_ = {};
  sphc_message bad_frame_ = {};  // why the last frame was left out
};

}  // namespace sphc::v4l2
