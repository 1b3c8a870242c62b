// The kernel's buffers: made, mapped, queued for the device to fill, taken back filled.
#pragma once

#include "node.h"
#include "v4l2.h"

struct v4l2_buffer;

namespace sphc::v4l2 {

// A buffer that the device has filled, as the kernel tells it; nothing of it is checked but `index`.
struct FilledBuffer {
  uint32_t index;
  uint32_t bytes_used;
  uint32_t flags;  // V4L2_BUF_FLAG_...
  uint32_t sequence;
  int64_t time_ns;  // negative: none that can be
};

class BufferRing {
 public:
  explicit BufferRing(const Node &node) : node_(node) {}
  ~BufferRing() { unmake(); }
  BufferRing(const BufferRing &) = delete;
  BufferRing &operator=(const BufferRing &) = delete;

  // At least `least` of the `wanted` buffers, each of `bytes` or more.
  sphc_status make(uint32_t wanted, uint32_t least, uint32_t bytes, bool export_dmabuf, sphc_message *message);

  // All buffers to the device, and go.
  sphc_status streamOn(sphc_message *message);
  // All buffers back, whoever had them.  Works on a device that is gone.
  void streamOff();

  // 0, EAGAIN when none is filled, or another errno; EPROTO when the kernel gave a buffer that it did not have.
  int dequeue(FilledBuffer *filled);
  // A buffer that was dequeued is no longer needed; it goes to the device now or, when that fails, in queueIdle().
  void giveBack(uint32_t index);
  void queueIdle();
  // Whether the device has at least one buffer to fill.
  bool deviceHasRoom() const;

  uint32_t count() const { return count_; }
  const uint8_t *data(uint32_t index) const { return buffers_[index].data; }
  size_t bytes(uint32_t index) const { return buffers_[index].bytes; }
  int dmabuf(uint32_t index) const { return buffers_[index].dmabuf; }  // -1: not exported

 private:
  enum class Owner { kNobody, kKernel, kCaller };
  struct Buffer {
    const uint8_t *data;  // null: not mapped
    size_t bytes;
    int dmabuf;
    Owner owner;
  };

  sphc_status map(uint32_t index, uint32_t bytes, bool export_dmabuf, sphc_message *message);
  int query(uint32_t index, v4l2_buffer *reply) const;
  int queue(uint32_t index);
  void syncDmabuf(const Buffer &buffer, uint64_t flags) const;
  void unmake();

  const Node &node_;
  uint32_t count_ = 0;
  bool is_requested_ = false;
  Buffer buffers_[SPHC_V4L2_MAX_BUFFERS] = {};
};

}  // namespace sphc::v4l2
