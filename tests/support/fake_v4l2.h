// A kernel whose cameras exist only in it, behind the V4L2 driver's table of system calls.
//
// Time in it passes only when somebody waits or looks at the clock, so every run is the same.  It keeps the rules
// of the real one (who owns a buffer, what is refused when) and lies on request.  Once streaming it allocates
// nothing.
#pragma once

#include <linux/videodev2.h>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "drivers/v4l2/syscalls.h"

namespace sphc::test {

struct FakeMode {
  uint32_t fourcc, width, height, fps;
};

struct FakeControl {
  uint32_t id;
  const char *name;
  uint32_t type;
  int64_t minimum, maximum, step, value;
  uint32_t flags;
};

// One frame on its way to a buffer.
struct FakeFrame {
  uint32_t number;  // of the exposure since stream-on
  uint8_t *data;
  uint32_t capacity;
  // What the kernel will tell; to be changed by a fault.
  uint32_t bytes_used, sequence, flags;
  int64_t time_ns;
  bool is_lost;
};

// Random-looking bytes that depend on the frame's number.
void paintPattern(uint32_t number, uint8_t *data, uint32_t bytes);

class FakeCamera {
 public:
  explicit FakeCamera(std::vector<FakeMode> its_modes) : modes(std::move(its_modes)) {}

  // What it is.
  std::string card = "Fake camera", bus = "usb-fake-1", driver = "fake";
  uint32_t caps = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  std::vector<FakeMode> modes;
  uint32_t row_padding = 0;
  uint32_t most_buffers = 32;
  uint32_t time_flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
  std::vector<FakeControl> controls;
  // The bytes of a frame; writes to frame.data and sets bytes_used.
  std::function<void(FakeFrame &)> paint = [](FakeFrame &frame) {
    paintPattern(frame.number, frame.data, frame.bytes_used);
  };
  // Faults: of what S_FMT answers, of each frame, of each buffer that DQBUF gives.
  std::function<void(v4l2_pix_format &)> bend_format = [](v4l2_pix_format &) {};
  std::function<void(FakeFrame &)> bend_frame = [](FakeFrame &) {};
  std::function<void(v4l2_buffer &)> bend_dequeued = [](v4l2_buffer &) {};
  bool is_stalled = false;
  // As by vb2_queue_error: until stream-off, DQBUF is EIO whatever waits, and poll POLLERR.
  bool is_given_up = false;

  FakeControl *findControl(uint32_t id);
  void pushEvent(uint32_t type, uint32_t id, uint32_t changes);

 private:
  friend class FakeKernel;
  enum class State { kFree, kQueued, kDone };
  struct Buffer {
    std::shared_ptr<uint8_t[]> data;  // shared, so that a camera not yet in use can be copied
    State state;
    v4l2_buffer told;
  };
  // First in, first out.
  struct IndexQueue {
    std::array<uint32_t, 32> indices = {};
    uint32_t count = 0;
    void push(uint32_t index) { indices.at(count++) = index; }
    uint32_t pop();
  };

  int ioctl(unsigned long request, void *argument, int64_t now_ns);
  int enumerate(v4l2_fmtdesc *description) const;
  int setFormat(v4l2_format *format);
  int period(bool is_set, v4l2_streamparm *parameters);
  int requestBuffers(v4l2_requestbuffers *request);
  int queryBuffer(v4l2_buffer *buffer) const;
  int queueBuffer(const v4l2_buffer &buffer);
  int dequeueBuffer(v4l2_buffer *buffer);
  int streamOn(int64_t now_ns);
  int streamOff();
  int queryControl(v4l2_query_ext_ctrl *query) const;
  int accessControl(bool is_set, v4l2_ext_controls *controls);
  int dequeueEvent(v4l2_event *event);
  void exposeUntil(int64_t now_ns);
  void expose();

  bool is_gone_ = false;
  FakeMode mode_ = {};
  uint32_t stride_bytes_ = 0, buffer_bytes_ = 0;
  std::vector<Buffer> buffers_;
  IndexQueue queued_, done_;
  bool is_streaming_ = false;
  uint32_t next_number_ = 0;
  int64_t next_frame_ns_ = 0;
  std::array<v4l2_event, 16> events_ = {};
  uint32_t event_count_ = 0;
  bool has_subscribed_ = false;
};

class FakeKernel {
 public:
  FakeKernel();
  FakeKernel(const FakeKernel &) = delete;

  const v4l2::Syscalls &syscalls() const { return syscalls_; }

  // As /dev/videoN.
  std::shared_ptr<FakeCamera> plugIn(uint32_t number, FakeCamera camera);
  void unplug(uint32_t number);

  // Faults, by the count of calls from now on (0: the next one): it fails with `error`; or everything is unplugged.
  void failCall(uint32_t call, int error);
  void unplugAtCall(uint32_t call);
  // By kind: the next `times` ioctls of this request fail; calls that are none have the numbers below.
  enum : unsigned long { kOpen = 1, kClose, kMmap, kMunmap, kPoll };
  void failRequest(unsigned long request, int error, uint32_t times = 1);

  uint32_t calls() const { return calls_; }
  uint32_t openFiles() const;
  uint32_t mappings() const;
  int32_t openReads() const;  // of dma-bufs, begun and not ended
  int64_t now_ns = 1000000000;

 private:
  struct File {
    std::shared_ptr<FakeCamera> camera;  // null: free
    int32_t buffer;                      // of a dma-buf; else -1
    int32_t reads;                       // of a dma-buf, begun and not ended
  };
  struct Mapping {
    std::shared_ptr<FakeCamera> camera;
    void *memory;
    size_t bytes;
  };
  static constexpr int kFirstFile = 1000;  // so that a real one is never meant

  int interfere(unsigned long request);
  int addFile(const std::shared_ptr<FakeCamera> &camera, int32_t buffer);
  File *fileOf(int fd);
  void pass(int64_t until_ns);

  int open(const char *path);
  int close(int fd);
  int ioctl(int fd, unsigned long request, void *argument);
  static int syncBuffer(File *file, unsigned long request, const void *argument);
  void *mmap(size_t bytes, int fd, int64_t offset);
  int munmap(void *memory, size_t bytes);
  int poll(pollfd *file, int64_t timeout_ns);

  v4l2::Syscalls syscalls_;
  std::array<std::shared_ptr<FakeCamera>, 16> nodes_;
  std::array<File, 64> files_ = {};
  std::array<Mapping, 128> mappings_ = {};
  uint32_t calls_ = 0;
  uint32_t fail_at_ = UINT32_MAX, unplug_at_ = UINT32_MAX;
  int fail_error_ = 0;
  unsigned long failing_request_ = 0;
  int failing_error_ = 0;
  uint32_t failing_times_ = 0;
};

}  // namespace sphc::test
