// Guidance beside a recording: a thread that takes a frame when it is free, and never makes the recording wait.
#pragma once
#include <spherecloud/spherecloud.h>

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace sphc::host {

class GuideThread {
 public:
  // `look` runs on the thread, with images that stay until it returns.  Where it throws, the thread takes no frame
  // any more.  Throws std::runtime_error where the system has no thread.
  explicit GuideThread(std::function<void(const sphc_localizer_frame &)> look);
  ~GuideThread();  // when the frame that it has is done
  GuideThread(const GuideThread &) = delete;
  GuideThread &operator=(const GuideThread &) = delete;

  // Copies the images if the thread is free; false, at once, if it is not.
  bool offer(const sphc_localizer_frame &frame);
  // Until the thread is free.
  void wait();
  // What `look` threw; "" while it did not.
  std::string failure();

 private:
  void run();

  std::function<void(const sphc_localizer_frame &)> look_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_busy_ = false, is_over_ = false;
  std::string failure_;
  sphc_localizer_frame frame_ = {};
  std::vector<uint8_t> color_, depth_;
  std::thread thread_;  // last: it uses the rest
};

}  // namespace sphc::host
