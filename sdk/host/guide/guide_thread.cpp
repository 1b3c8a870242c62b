#include "host/guide/guide_thread.h"

#include <sys/resource.h>

#include <cstring>
#include <exception>
#include <stdexcept>
#include <system_error>

namespace sphc::host {
namespace {

constexpr int kNiceness = 10;  // what records goes first

// Rows without padding.
sphc_image copyOf(const sphc_image &image, std::vector<uint8_t> *pixels) {
  const uint32_t row_bytes = sphc_format_row_bytes(image.format, image.width);
  pixels->resize(size_t{row_bytes} * image.height);
  for (uint32_t y = 0; y < image.height; ++y)
    std::memcpy(pixels->data() + size_t{y} * row_bytes,
                static_cast<const uint8_t *>(image.data) + size_t{y} * image.stride_bytes, row_bytes);
  sphc_image copy = image;
  copy.data = pixels->data();
  copy.stride_bytes = row_bytes;
  return copy;
}

}  // namespace

GuideThread::GuideThread(std::function<void(const sphc_localizer_frame &)> look) : look_(std::move(look)) {
  try {
    thread_ = std::thread([this] { run(); });
  } catch (const std::system_error &) {
    throw std::runtime_error("no thread for the guide: there are too many, or too little memory for one more");
  }
}

GuideThread::~GuideThread() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_over_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

bool GuideThread::offer(const sphc_localizer_frame &frame) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (is_busy_ || !failure_.empty()) return false;
    frame_ = frame;
    frame_.color = copyOf(frame.color, &color_);
    frame_.depth = copyOf(frame.depth, &depth_);
    frame_.amplitude = {};
    is_busy_ = true;
  }
  changed_.notify_all();
  return true;
}

void GuideThread::wait() {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [this] { return !is_busy_; });
}

std::string GuideThread::failure() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return failure_;
}

void GuideThread::run() {
  setpriority(PRIO_PROCESS, 0, kNiceness);  // of Linux: of this thread alone
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return is_busy_ || is_over_; });
    if (!is_busy_) return;
    lock.unlock();
    std::string failure;
    try {
      look_(frame_);
    } catch (const std::exception &error) {
      failure = error.what();
    }
    lock.lock();
    failure_ = failure;
    is_busy_ = false;
    changed_.notify_all();
  }
}

}  // namespace sphc::host
