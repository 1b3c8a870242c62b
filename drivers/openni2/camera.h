// A device and its buffers as one source.
#pragma once

#include <atomic>
#include <mutex>

#include "capture_queue.h"
#include "device.h"
#include "listeners.h"
#include "reader.h"
#include "spherecloud/spherecloud_capture.h"
#include "timeline.h"

namespace sphc::openni2 {

class Camera final : private DeviceWatcher, private ReaderJob {
 public:
  Camera() = default;
  ~Camera();

  sphc_status open(const char *uri, const sphc_openni2_config &config, sphc_message *message);

  sphc_status start();
  sphc_status acquire(uint32_t timeout_us, sphc_capture *capture);
  void release(const sphc_capture &capture) { queue_.release(capture); }
  void stop();

  Device &device() { return device_; }
  const sphc_openni2_info &info() const { return info_; }
  void copyCounts(sphc_openni2_counts *color, sphc_openni2_counts *depth) const { queue_.copyCounts(color, depth); }
  uint32_t loanLimit() const { return config_.loan_limit; }
  sphc_message *messageRoom() { return &message_; }
  const char *message() const { return message_.text; }

 private:
  static void ONI_CALLBACK_TYPE onNewFrame(OniStreamHandle handle, void *camera);
  void onGone() override;
  void onState(OniDeviceState state) override;

  sphc_status openDevice(sphc_message *message);
  void closeDevice();
  sphc_status listen(sphc_message *message);
  bool isAsOpened() const;
  QueueConfig queueConfig() const;
  int64_t periodNs(int stream) const { return 1000000000 / device_.mode(stream).fps; }

  sphc_status acquireFromFile(int64_t until_ns, sphc_capture *capture);
  bool readFromFile(int64_t until_ns);
  bool beginsAnew(int stream, const OniFrame &frame);
  void read() override;
  bool readOne(int stream);
  void accept(int stream, const OniFrame &frame, int64_t arrival_ns);
  sphc_capture makeCapture(int stream, const Place &place, int64_t arrival_ns) const;

  Library library_;
  char uri_[ONI_MAX_STR] = "";
  sphc_openni2_config config_ = {};
  sphc_openni2_info info_ = {};
  Device device_;
  Listeners listeners_;
  CaptureQueue queue_;
  bool running_ = false;
  // Of a recording:
  bool played_ = false;  // is behind its beginning
  int first_index_[kStreams] = {}, last_index_[kStreams] = {};
  int64_t silent_ns_ = 0;  // how long it was asked in vain
  std::atomic<bool> gone_{false};

  std::mutex reading_;      // what follows is under it
  bool listening_ = false;  // the reader, if it comes later, finds nothing to do
  Timeline timeline_;

  sphc_message message_ = {};
};

}  // namespace sphc::openni2
