// One camera of libcamera: acquired, configured, its requests going around.
#pragma once

#include <libcamera/libcamera.h>

#include <array>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "../plugin.h"
#include "mapped_buffer.h"

namespace sphc::libcamera_plugin {

// The one manager that a process may have; made with the first user, gone with the last, and its thread with it.
std::shared_ptr<libcamera::CameraManager> sharedManager();

// Failures are exceptions of type Refusal; plugin.cpp turns them into statuses.
struct Refusal {
  sphc_status status;
  std::string text;
};

sphc_libcamera_name nameOf(const libcamera::Camera &camera);

class Device {
 public:
  explicit Device(const char *id);  // null: the first
  ~Device();
  Device(const Device &) = delete;
  Device &operator=(const Device &) = delete;

  sphc_libcamera_name name() const { return nameOf(*camera_); }
  std::vector<libcamera::PixelFormat> formats() const;
  void configure(sphc_libcamera_mode &mode);
  const std::vector<MappedBuffer> &buffers() const { return mapped_; }
  sphc_libcamera_range control(const char *control_name) const;
  void set(const char *control_name, int64_t value);

  void start();
  // Allocates nothing, whatever happens.
  sphc_status wait(uint32_t timeout_us, sphc_libcamera_frame &frame, sphc_message *message);
  void queue(uint32_t buffer);
  void stop();

 private:
  Device() : manager_(sharedManager()) {}
  std::shared_ptr<libcamera::Camera> find(const char *id) const;
  void makeRequests();
  void freeBuffers();
  // These two run on the manager's thread.
  void completed(libcamera::Request *request);
  void disconnected();

  std::shared_ptr<libcamera::CameraManager> manager_;
  std::shared_ptr<libcamera::Camera> camera_;  // acquired; null before
  std::string id_;
  std::unique_ptr<libcamera::CameraConfiguration> configuration_;
  std::unique_ptr<libcamera::FrameBufferAllocator> allocator_;
  std::vector<MappedBuffer> mapped_;
  std::vector<std::unique_ptr<libcamera::Request>> requests_;  // the i-th owns buffer i
  std::vector<std::pair<unsigned int, libcamera::ControlValue>> settings_;
  bool running_ = false;

  std::mutex mutex_;  // of what follows
  std::condition_variable changed_;
  std::array<uint32_t, SPHC_LIBCAMERA_BUFFERS_MAX> done_ = {};  // a ring of buffers, oldest first
  uint32_t first_done_ = 0, done_count_ = 0;
  bool lost_ = false, stopping_ = false;
  int queue_error_ = 0;
  std::array<bool, SPHC_LIBCAMERA_BUFFERS_MAX> is_back_ = {};  // buffers that came back without a frame
};

}  // namespace sphc::libcamera_plugin
