// The buffers of a source: filled by the reader, waiting in order of time, on loan to the caller.
#pragma once

#include <memory>
#include <mutex>

#include "openni2.h"
#include "spherecloud/spherecloud_capture.h"
#include "streams.h"
#include "wakeup.h"

namespace sphc::openni2 {

constexpr uint32_t kMaxBuffers = 64;

struct QueueConfig {
  bool is_recording;  // nothing is hurried: no stalls, no loss for want of buffers
  bool runs[kStreams];
  int64_t period_ns[kStreams];
  int64_t order_wait_ns, stall_ns;
};

// Where the bytes of one image are.
struct Pixels {
  const uint8_t *data;
  size_t row_bytes, stride_bytes, rows;
};

class CaptureQueue {
 public:
  // False: out of memory.
  bool open(uint32_t buffers, size_t buffer_bytes);

  void start(const QueueConfig &config);
  void stop();

  // ---- one producer at a time ----
  // Copies the pixels; sets token and data.  Without room the oldest capture that waits goes.
  void push(int stream, sphc_capture capture, const Pixels &pixels);
  // For the next acquire, unless there is such news already.
  void report(sphc_status status, const char *text);
  template <typename Change>
  void count(int stream, Change change) {
    const std::lock_guard<Wakeup> lock(wakeup_);
    change(counts_[stream]);
  }
  void deviceGone();
  void endReached();

  // ---- the consumer ----
  // SPHC_AGAIN: nothing until `until_ns`.
  sphc_status take(int64_t until_ns, sphc_capture *capture, sphc_message *message);
  void release(const sphc_capture &capture);
  void copyCounts(sphc_openni2_counts *color, sphc_openni2_counts *depth) const;

 private:
  enum State { kFree, kFilling, kWaiting, kLent };
  struct Buffer {
    State state;
    int stream;
    sphc_capture capture;
    uint8_t *pixels;
  };

  Buffer *claim(int stream, int64_t time_ns);
  Buffer *find(State state);
  Buffer *earliest();
  bool mayGo(const Buffer &buffer, int64_t now_ns);
  uint32_t number(State state) const;
  void noticeStalls(int64_t now_ns);
  void lend(Buffer &buffer, sphc_capture *capture);
  sphc_status explainEnd(sphc_message *message) const;
  int64_t nextChange(int64_t until_ns);

  mutable Wakeup wakeup_;
  std::unique_ptr<uint8_t[]> memory_;
  Buffer buffers_[kMaxBuffers] = {};
  uint32_t buffer_count_ = 0;
  QueueConfig config_ = {};
  bool running_ = false, gone_ = false, ended_ = false;
  uint64_t last_token_ = 0;  // counts through restarts, so that an old loan is never taken for a new one
  int64_t last_given_ns_ = 0;
  int64_t last_time_ns_[kStreams] = {}, last_arrival_ns_[kStreams] = {};
  bool stalled_[kStreams] = {};
  sphc_openni2_counts counts_[kStreams] = {};
  sphc_status news_ = SPHC_OK;
  sphc_message news_text_ = {};
};

}  // namespace sphc::openni2
