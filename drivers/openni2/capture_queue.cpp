#include "capture_queue.h"

#include <algorithm>
#include <cstring>
#include <new>

#include "explain.h"

namespace sphc::openni2 {

namespace {

using Lock = std::lock_guard<Wakeup>;
constexpr size_t kAlignment = 64;

}  // namespace

bool CaptureQueue::open(uint32_t buffers, size_t buffer_bytes) {
  if (buffer_bytes > SIZE_MAX / buffers - kAlignment) return false;  // a device names the sizes of its images
  const size_t pitch = (buffer_bytes + kAlignment - 1) / kAlignment * kAlignment;
  memory_.reset(new (std::nothrow) uint8_t[buffers * pitch]);
  if (!memory_) return false;
  std::memset(memory_.get(), 0, buffers * pitch);  // the pages, too, are there before start
  buffer_count_ = buffers;
  for (uint32_t i = 0; i < buffers; ++i) buffers_[i].pixels = memory_.get() + i * pitch;
  return true;
}

void CaptureQueue::start(const QueueConfig &config) {
  const Lock lock(wakeup_);
  config_ = config;
  running_ = true;
  ended_ = false;
  news_ = SPHC_OK;
  last_given_ns_ = INT64_MIN;
  for (int stream = 0; stream < kStreams; ++stream) {
    last_time_ns_[stream] = INT64_MIN;
    last_arrival_ns_[stream] = monotonicNs();
    stalled_[stream] = false;
    counts_[stream] = {};
  }
}

void CaptureQueue::stop() {
  const Lock lock(wakeup_);
  running_ = false;
  for (Buffer &buffer : buffers_) buffer.state = kFree;
}

// ---- the producer's side ----

void CaptureQueue::push(int stream, sphc_capture capture, const Pixels &pixels) {
  Buffer *buffer = claim(stream, capture.time_ns);
  if (!buffer) return;
  for (size_t y = 0; y < pixels.rows; ++y)
    std::memcpy(buffer->pixels + y * pixels.row_bytes, pixels.data + y * pixels.stride_bytes, pixels.row_bytes);
  const Lock lock(wakeup_);
  buffer->state = kWaiting;
  buffer->capture = capture;
  buffer->capture.image.data = buffer->pixels;
  buffer->capture.token = ++last_token_;
  last_time_ns_[stream] = capture.time_ns;
  wakeup_.wake();
}

// A buffer to fill; null when the capture comes too late, or all are on loan.
CaptureQueue::Buffer *CaptureQueue::claim(int stream, int64_t time_ns) {
  const Lock lock(wakeup_);
  if (!running_) return nullptr;
  last_arrival_ns_[stream] = monotonicNs();
  stalled_[stream] = false;
  if (time_ns < last_given_ns_) {
    ++counts_[stream].late;
    return nullptr;
  }
  Buffer *buffer = find(kFree);
  if (!buffer) {
    buffer = earliest();
    ++counts_[buffer ? buffer->stream : stream].overrun;
  }
  if (!buffer) return nullptr;
  buffer->state = kFilling;
  buffer->stream = stream;
  return buffer;
}

void CaptureQueue::report(sphc_status status, const char *text) {
  const Lock lock(wakeup_);
  if (!running_ || news_ != SPHC_OK) return;
  news_ = status;
  explain(&news_text_, status, "%s", text);
  wakeup_.wake();
}

void CaptureQueue::deviceGone() {
  const Lock lock(wakeup_);
  gone_ = true;
  wakeup_.wake();
}

void CaptureQueue::endReached() {
  const Lock lock(wakeup_);
  ended_ = true;
  wakeup_.wake();
}

// ---- the consumer's side ----

sphc_status CaptureQueue::take(int64_t until_ns, sphc_capture *capture, sphc_message *message) {
  const Lock lock(wakeup_);
  if (!running_) return explain(message, SPHC_E_STATE, "acquire: not running; call start first");
  if (number(kLent) == buffer_count_)
    return explain(message, SPHC_E_STATE, "acquire: all %u captures are on loan; release one first", buffer_count_);
  for (;;) {
    const int64_t now_ns = monotonicNs();
    Buffer *buffer = earliest();
    noticeStalls(now_ns);
    if (news_ != SPHC_OK) {
      const sphc_status status = news_;
      news_ = SPHC_OK;
      return explain(message, status, "%s", news_text_.text);
    }
    if (buffer && mayGo(*buffer, now_ns)) {
      lend(*buffer, capture);
      return SPHC_OK;
    }
    if (!buffer && (gone_ || ended_)) return explainEnd(message);
    if (now_ns >= until_ns) return SPHC_AGAIN;
    wakeup_.waitUntil(nextChange(until_ns));
  }
}

sphc_status CaptureQueue::explainEnd(sphc_message *message) const {
  if (ended_ && !gone_) return SPHC_END;
  return explain(message, SPHC_E_DEVICE_LOST,
                 "acquire: the device was unplugged, or lost its power; close, plug it in, and open it again");
}

// True when no older capture of the other stream is to be expected.
bool CaptureQueue::mayGo(const Buffer &buffer, int64_t now_ns) {
  const int other = otherStream(buffer.stream);
  if (!config_.runs[other] || gone_ || ended_ || !find(kFree)) return true;
  for (uint32_t i = 0; i < buffer_count_; ++i)
    if (buffers_[i].state == kWaiting && buffers_[i].stream == other) return true;
  const int64_t last_ns = last_time_ns_[other];
  if (last_ns != INT64_MIN && last_ns + config_.period_ns[other] / 4 * 3 > buffer.capture.time_ns) return true;
  return !config_.is_recording && now_ns >= buffer.capture.arrival_ns + config_.order_wait_ns;
}

// When waiting may have to end though nothing woke it.
int64_t CaptureQueue::nextChange(int64_t until_ns) {
  if (config_.is_recording) return until_ns;
  const Buffer *buffer = earliest();
  if (buffer) until_ns = std::min(until_ns, buffer->capture.arrival_ns + config_.order_wait_ns);
  for (int stream = 0; stream < kStreams; ++stream)
    if (config_.runs[stream] && !stalled_[stream])
      until_ns = std::min(until_ns, last_arrival_ns_[stream] + config_.stall_ns);
  return until_ns;
}

void CaptureQueue::noticeStalls(int64_t now_ns) {
  if (config_.is_recording || gone_) return;
  for (int stream = 0; stream < kStreams && news_ == SPHC_OK; ++stream) {
    if (!config_.runs[stream] || stalled_[stream] || now_ns < last_arrival_ns_[stream] + config_.stall_ns) continue;
    stalled_[stream] = true;
    ++counts_[stream].stalls;
    news_ = explain(&news_text_, SPHC_E_DEVICE,
                    "acquire: no %s frame for %lld ms; if it goes on: another USB port or cable, no hub, other "
                    "programs closed, or stop and start",
                    kStreamNames[stream], static_cast<long long>((now_ns - last_arrival_ns_[stream]) / 1000000));
  }
}

void CaptureQueue::lend(Buffer &buffer, sphc_capture *capture) {
  buffer.state = kLent;
  last_given_ns_ = buffer.capture.time_ns;
  ++counts_[buffer.stream].captured;
  *capture = buffer.capture;
}

void CaptureQueue::release(const sphc_capture &capture) {
  const Lock lock(wakeup_);
  for (uint32_t i = 0; i < buffer_count_; ++i) {
    Buffer &buffer = buffers_[i];
    if (buffer.state == kLent && buffer.capture.token == capture.token && buffer.pixels == capture.image.data)
      buffer.state = kFree;
  }
}

void CaptureQueue::copyCounts(sphc_openni2_counts *color, sphc_openni2_counts *depth) const {
  const Lock lock(wakeup_);
  *color = counts_[kColor];
  *depth = counts_[kDepth];
}

// ---- under the lock ----

CaptureQueue::Buffer *CaptureQueue::find(State state) {
  Buffer *end = buffers_ + buffer_count_;
  Buffer *found = std::find_if(buffers_, end, [&](const Buffer &buffer) { return buffer.state == state; });
  return found == end ? nullptr : found;
}

// Of those that wait the first in time.
CaptureQueue::Buffer *CaptureQueue::earliest() {
  Buffer *first = nullptr;
  for (uint32_t i = 0; i < buffer_count_; ++i) {
    Buffer &buffer = buffers_[i];
    if (buffer.state == kWaiting && (!first || buffer.capture.time_ns < first->capture.time_ns)) first = &buffer;
  }
  return first;
}

uint32_t CaptureQueue::number(State state) const {
  return static_cast<uint32_t>(std::count_if(buffers_, buffers_ + buffer_count_,
                                             [&](const Buffer &buffer) { return buffer.state == state; }));
}

}  // namespace sphc::openni2
