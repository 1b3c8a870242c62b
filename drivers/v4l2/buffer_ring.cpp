#include "buffer_ring.h"

#include <fcntl.h>
#include <linux/dma-buf.h>
#include <linux/videodev2.h>
#include <sys/mman.h>

#include <algorithm>
#include <cerrno>

#include "drivers/pixels/explain.h"

namespace sphc::v4l2 {

namespace {

using pixels::explain;

v4l2_buffer captureBuffer(uint32_t index) {
  v4l2_buffer buffer = {};
  buffer.index = index;
  buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  buffer.memory = V4L2_MEMORY_MMAP;
  return buffer;
}

int64_t nanoseconds(const timeval &time) {
  constexpr int64_t kMaxSeconds = INT64_MAX / 1000000000 - 1;
  const bool can_be = time.tv_sec >= 0 && time.tv_sec <= kMaxSeconds && time.tv_usec >= 0 && time.tv_usec < 1000000;
  return can_be ? int64_t{time.tv_sec} * 1000000000 + int64_t{time.tv_usec} * 1000 : -1;
}

}  // namespace

sphc_status BufferRing::make(uint32_t wanted, uint32_t least, uint32_t bytes, bool export_dmabuf,
                             sphc_message *message) {
  v4l2_requestbuffers request = {};
  request.count = wanted;
  request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  request.memory = V4L2_MEMORY_MMAP;
  if (const int error = node_.ioctl(VIDIOC_REQBUFS, &request))
    return node_.explain(message, "VIDIOC_REQBUFS", error);
  is_requested_ = true;
  if (request.count < least)
    return explain(message, SPHC_E_DEVICE, "%s gave %u buffers of the %u asked for, and %u are needed; %s",
                   node_.path(), request.count, wanted, least,
                   export_dmabuf ? "lower loan_limit or set export_dmabuf to 0" : "use another camera");
  const uint32_t count = std::min(request.count, SPHC_V4L2_MAX_BUFFERS);
  for (uint32_t i = 0; i < count; ++i) {
    buffers_[i].dmabuf = -1;
    count_ = i + 1;  // unmake() takes care of it from now on
    const sphc_status status = map(i, bytes, export_dmabuf, message);
    if (status < 0) return status;
  }
  return SPHC_OK;
}

int BufferRing::query(uint32_t index, v4l2_buffer *reply) const {
  *reply = captureBuffer(index);
  return node_.ioctl(VIDIOC_QUERYBUF, reply);
}

sphc_status BufferRing::map(uint32_t index, uint32_t bytes, bool export_dmabuf, sphc_message *message) {
  Buffer &buffer = buffers_[index];
  v4l2_buffer reply;
  if (const int error = query(index, &reply)) return node_.explain(message, "VIDIOC_QUERYBUF", error);
  if (reply.length < bytes)
    return explain(message, SPHC_E_DEVICE, "%s: buffer %u has %u bytes; the mode needs %u", node_.path(), index,
                   reply.length, bytes);
  int fd = node_.fd();
  int64_t offset = reply.m.offset;
  if (export_dmabuf) {
    v4l2_exportbuffer exported = {};
    exported.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    exported.index = index;
    exported.flags = O_CLOEXEC | O_RDONLY;
    const int error = node_.ioctl(VIDIOC_EXPBUF, &exported);
    if (error == ENOTTY || error == EINVAL)
      return explain(message, SPHC_E_UNSUPPORTED,
                     "%s: cannot export dma-bufs (errno %d); set config.export_dmabuf to 0", node_.path(), error);
    if (error) return node_.explain(message, "VIDIOC_EXPBUF", error);
    buffer.dmabuf = fd = exported.fd;
    offset = 0;
  }
  const Syscalls &syscalls = node_.syscalls();
  void *memory = syscalls.mmap(syscalls.self, reply.length, PROT_READ, MAP_SHARED, fd, offset);
  if (memory == MAP_FAILED) return node_.explain(message, "mmap", errno);
  buffer.data = static_cast<const uint8_t *>(memory);
  buffer.bytes = reply.length;
  return SPHC_OK;
}

void BufferRing::unmake() {
  const Syscalls &syscalls = node_.syscalls();
  for (uint32_t i = 0; i < count_; ++i) {
    Buffer &buffer = buffers_[i];
    if (buffer.data) syscalls.munmap(syscalls.self, const_cast<uint8_t *>(buffer.data), buffer.bytes);
    if (buffer.dmabuf >= 0) syscalls.close(syscalls.self, buffer.dmabuf);
    buffer = {};
  }
  count_ = 0;
  if (!is_requested_) return;
  v4l2_requestbuffers none = {};
  none.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  none.memory = V4L2_MEMORY_MMAP;
  node_.ioctl(VIDIOC_REQBUFS, &none);  // closing would free them too; a device that is gone refuses
  is_requested_ = false;
}

int BufferRing::queue(uint32_t index) {
  v4l2_buffer buffer = captureBuffer(index);
  const int error = node_.ioctl(VIDIOC_QBUF, &buffer);
  if (error == 0) buffers_[index].owner = Owner::kKernel;
  return error;
}

sphc_status BufferRing::streamOn(sphc_message *message) {
  for (uint32_t i = 0; i < count_; ++i)
    if (const int error = queue(i)) {
      streamOff();
      return node_.explain(message, "VIDIOC_QBUF", error);
    }
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (const int error = node_.ioctl(VIDIOC_STREAMON, &type)) {
    streamOff();
    return node_.explain(message, "VIDIOC_STREAMON", error);
  }
  return SPHC_OK;
}

void BufferRing::streamOff() {
  for (uint32_t i = 0; i < count_; ++i) {
    if (buffers_[i].owner == Owner::kCaller) syncDmabuf(buffers_[i], DMA_BUF_SYNC_END | DMA_BUF_SYNC_READ);
    buffers_[i].owner = Owner::kNobody;
  }
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  node_.ioctl(VIDIOC_STREAMOFF, &type);
}

int BufferRing::dequeue(FilledBuffer *filled) {
  v4l2_buffer reply = captureBuffer(0);
  if (const int error = node_.ioctl(VIDIOC_DQBUF, &reply)) return error;
  if (reply.index >= count_ || buffers_[reply.index].owner != Owner::kKernel) return EPROTO;
  Buffer &buffer = buffers_[reply.index];
  buffer.owner = Owner::kCaller;
  syncDmabuf(buffer, DMA_BUF_SYNC_START | DMA_BUF_SYNC_READ);
  *filled = {reply.index, reply.bytesused, reply.flags, reply.sequence, nanoseconds(reply.timestamp)};
  return 0;
}

void BufferRing::giveBack(uint32_t index) {
  syncDmabuf(buffers_[index], DMA_BUF_SYNC_END | DMA_BUF_SYNC_READ);
  buffers_[index].owner = Owner::kNobody;
  queue(index);
}

void BufferRing::queueIdle() {
  for (uint32_t i = 0; i < count_; ++i)
    if (buffers_[i].owner == Owner::kNobody) queue(i);
}

bool BufferRing::deviceHasRoom() const {
  for (uint32_t i = 0; i < count_; ++i) {
    v4l2_buffer reply;
    if (buffers_[i].owner != Owner::kKernel) continue;
    if (query(i, &reply) != 0) return true;  // nothing is known then
    if ((reply.flags & V4L2_BUF_FLAG_QUEUED) && !(reply.flags & V4L2_BUF_FLAG_DONE)) return true;
  }
  return false;
}

// So that the processor sees what the device wrote.  Most exporters on coherent machines have nothing to do.
void BufferRing::syncDmabuf(const Buffer &buffer, uint64_t flags) const {
  dma_buf_sync sync = {flags};
  if (buffer.dmabuf >= 0) node_.ioctlOf(buffer.dmabuf, DMA_BUF_IOCTL_SYNC, &sync);
}

}  // namespace sphc::v4l2
