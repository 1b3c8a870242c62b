#include "tests/support/fake_v4l2.h"

#include <linux/dma-buf.h>
#include <poll.h>
#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "drivers/v4l2/pixel_format.h"

namespace sphc::test {

namespace {

constexpr int64_t kSecondNs = 1000000000;
constexpr int64_t kLookNs = 1000;  // what reading the clock takes

template <size_t kSize>
void setText(__u8 (&to)[kSize], const std::string &text) {
  std::strncpy(reinterpret_cast<char *>(to), text.c_str(), kSize - 1);
}

int failWith(int error) {
  errno = error;
  return -1;
}

}  // namespace

void paintPattern(uint32_t number, uint8_t *data, uint32_t bytes) {
  uint32_t state = number * 2654435761u + 12345;
  for (uint32_t i = 0; i < bytes; ++i) {
    state = state * 1664525 + 1013904223;
    data[i] = static_cast<uint8_t>(state >> 24);
  }
}

// ---- camera: format --------------------------------------------------------------------------------------------

int FakeCamera::enumerate(v4l2_fmtdesc *description) const {
  std::vector<uint32_t> fourccs;
  for (const FakeMode &mode : modes)
    if (std::count(fourccs.begin(), fourccs.end(), mode.fourcc) == 0) fourccs.push_back(mode.fourcc);
  if (description->index >= fourccs.size()) return EINVAL;
  description->pixelformat = fourccs[description->index];
  return 0;
}

// Silently the first mode of that layout, or the very first, when it has none of that size; as real drivers do.
int FakeCamera::setFormat(v4l2_format *format) {
  if (!buffers_.empty()) return EBUSY;
  v4l2_pix_format &pix = format->fmt.pix;
  const FakeMode *taken = &modes.front();
  for (auto it = modes.rbegin(); it != modes.rend(); ++it)
    if (it->fourcc == pix.pixelformat) taken = &*it;
  for (const FakeMode &mode : modes)
    if (mode.fourcc == pix.pixelformat && mode.width == pix.width && mode.height == pix.height) taken = &mode;
  mode_ = *taken;
  const v4l2::PixelFormat *known = v4l2::findPixelFormat(mode_.fourcc);
  const bool is_raw = known && !known->is_jpeg;
  pix.width = mode_.width;
  pix.height = mode_.height;
  pix.pixelformat = mode_.fourcc;
  pix.field = V4L2_FIELD_NONE;
  pix.bytesperline = is_raw ? pixels::rowBytes(known->layout, mode_.width) + row_padding : 0;
  pix.sizeimage = is_raw ? pix.bytesperline * mode_.height : mode_.width * mode_.height * 2;
  if (is_raw && known->layout == pixels::Layout::Nv12) pix.sizeimage = pix.sizeimage * 3 / 2;
  bend_format(pix);
  stride_bytes_ = pix.bytesperline;
  buffer_bytes_ = pix.sizeimage;
  return 0;
}

int FakeCamera::period(bool is_set, v4l2_streamparm *parameters) {
  if (is_set && is_streaming_) return EBUSY;
  parameters->parm.capture.capability = V4L2_CAP_TIMEPERFRAME;
  parameters->parm.capture.timeperframe = {1, mode_.fps};
  return 0;
}

// ---- camera: buffers -------------------------------------------------------------------------------------------

uint32_t FakeCamera::IndexQueue::pop() {
  const uint32_t first = indices.at(0);
  std::copy(indices.begin() + 1, indices.end(), indices.begin());
  --count;
  return first;
}

int FakeCamera::requestBuffers(v4l2_requestbuffers *request) {
  if (is_streaming_) return EBUSY;
  request->count = std::min(request->count, most_buffers);
  buffers_.clear();
  buffers_.resize(request->count);
  for (uint32_t i = 0; i < request->count; ++i) {
    buffers_[i].data.reset(new uint8_t[buffer_bytes_]());  // exactly sized: a sanitizer sees who reads beyond
    buffers_[i].told = {};
    buffers_[i].told.index = i;
    buffers_[i].told.length = buffer_bytes_;
    buffers_[i].told.m.offset = i << 20;
  }
  return 0;
}

int FakeCamera::queryBuffer(v4l2_buffer *buffer) const {
  if (buffer->index >= buffers_.size()) return EINVAL;
  const Buffer &own = buffers_[buffer->index];
  *buffer = own.told;
  buffer->flags = own.state == State::kQueued ? V4L2_BUF_FLAG_QUEUED
                  : own.state == State::kDone ? V4L2_BUF_FLAG_DONE
                                              : 0;
  return 0;
}

int FakeCamera::queueBuffer(const v4l2_buffer &buffer) {
  if (buffer.index >= buffers_.size() || buffers_[buffer.index].state != State::kFree) return EINVAL;
  buffers_[buffer.index].state = State::kQueued;
  queued_.push(buffer.index);
  return 0;
}

int FakeCamera::dequeueBuffer(v4l2_buffer *buffer) {
  if (!is_streaming_) return EINVAL;
  if (is_given_up) return EIO;
  if (done_.count == 0) return EAGAIN;
  Buffer &own = buffers_[done_.pop()];
  own.state = State::kFree;
  *buffer = own.told;
  bend_dequeued(*buffer);
  return 0;
}

int FakeCamera::streamOn(int64_t now_ns) {
  if (buffers_.empty()) return EINVAL;
  is_streaming_ = true;
  next_number_ = 0;
  next_frame_ns_ = now_ns + kSecondNs / mode_.fps;
  return 0;
}

int FakeCamera::streamOff() {
  is_streaming_ = is_given_up = false;
  queued_.count = done_.count = 0;
  for (Buffer &buffer : buffers_) buffer.state = State::kFree;
  return 0;
}

// ---- camera: exposing ------------------------------------------------------------------------------------------

void FakeCamera::exposeUntil(int64_t now_ns) {
  while (is_streaming_ && !is_stalled && !is_given_up && next_frame_ns_ <= now_ns) {
    expose();
    next_frame_ns_ += kSecondNs / mode_.fps;
  }
}

void FakeCamera::expose() {
  const uint32_t number = next_number_++;
  if (queued_.count == 0) return;  // no room: the frame is lost, and only the count of the next tells
  const uint32_t index = queued_.indices[0];
  Buffer &buffer = buffers_[index];
  const uint32_t raw_bytes = buffer_bytes_;
  FakeFrame frame = {number, buffer.data.get(), buffer_bytes_,  raw_bytes,
                     number, time_flags,        next_frame_ns_, false};
  paint(frame);
  bend_frame(frame);
  if (frame.is_lost) return;
  queued_.pop();
  buffer.state = State::kDone;
  buffer.told.bytesused = frame.bytes_used;
  buffer.told.sequence = frame.sequence;
  buffer.told.flags = frame.flags;
  buffer.told.timestamp.tv_sec = frame.time_ns / kSecondNs;
  buffer.told.timestamp.tv_usec = frame.time_ns % kSecondNs / 1000;
  done_.push(index);
}

// ---- camera: controls and events -------------------------------------------------------------------------------

FakeControl *FakeCamera::findControl(uint32_t id) {
  const auto it = std::find_if(controls.begin(), controls.end(), [&](const FakeControl &c) { return c.id == id; });
  return it == controls.end() ? nullptr : &*it;
}

int FakeCamera::queryControl(v4l2_query_ext_ctrl *query) const {
  const uint32_t id = query->id & V4L2_CTRL_ID_MASK;
  const bool is_next = (query->id & V4L2_CTRL_FLAG_NEXT_CTRL) != 0;
  const auto it = std::find_if(controls.begin(), controls.end(),
                               [&](const FakeControl &c) { return is_next ? c.id > id : c.id == id; });
  if (it == controls.end()) return EINVAL;
  *query = {};
  query->id = it->id;
  query->type = it->type;
  std::strncpy(query->name, it->name, sizeof query->name - 1);
  query->minimum = it->minimum;
  query->maximum = it->maximum;
  query->step = static_cast<uint64_t>(it->step);
  query->default_value = it->minimum;
  query->flags = it->flags;
  return 0;
}

int FakeCamera::accessControl(bool is_set, v4l2_ext_controls *request) {
  v4l2_ext_control &value = request->controls[0];
  FakeControl *control = findControl(value.id);
  if (!control) return EINVAL;
  const bool is_wide = control->type == V4L2_CTRL_TYPE_INTEGER64;
  if (is_set) {
    const int64_t wanted = is_wide ? value.value64 : value.value;
    control->value = std::clamp(wanted, control->minimum, control->maximum);  // silently
    pushEvent(V4L2_EVENT_CTRL, value.id, V4L2_EVENT_CTRL_CH_VALUE);
  } else if (is_wide) {
    value.value64 = control->value;
  } else {
    value.value = static_cast<int32_t>(control->value);
  }
  return 0;
}

void FakeCamera::pushEvent(uint32_t type, uint32_t id, uint32_t changes) {
  if (!has_subscribed_ || event_count_ == events_.size()) return;
  v4l2_event event = {};
  event.type = type;
  event.id = id;
  if (type == V4L2_EVENT_CTRL)
    event.u.ctrl.changes = changes;
  else
    event.u.src_change.changes = changes;
  events_[event_count_++] = event;
}

int FakeCamera::dequeueEvent(v4l2_event *event) {
  if (event_count_ == 0) return ENOENT;
  *event = events_[0];
  std::copy(events_.begin() + 1, events_.end(), events_.begin());
  --event_count_;
  return 0;
}

int FakeCamera::ioctl(unsigned long request, void *argument, int64_t now_ns) {
  switch (request) {
    case VIDIOC_QUERYCAP: {
      auto *reply = static_cast<v4l2_capability *>(argument);
      setText(reply->card, card);
      setText(reply->bus_info, bus);
      setText(reply->driver, driver);
      reply->device_caps = caps;
      reply->capabilities = caps | V4L2_CAP_DEVICE_CAPS | V4L2_CAP_META_CAPTURE;
      return 0;
    }
    case VIDIOC_ENUM_FMT:
      return enumerate(static_cast<v4l2_fmtdesc *>(argument));
    case VIDIOC_S_FMT:
      return setFormat(static_cast<v4l2_format *>(argument));
    case VIDIOC_S_PARM:
      return period(true, static_cast<v4l2_streamparm *>(argument));
    case VIDIOC_G_PARM:
      return period(false, static_cast<v4l2_streamparm *>(argument));
    case VIDIOC_REQBUFS:
      return requestBuffers(static_cast<v4l2_requestbuffers *>(argument));
    case VIDIOC_QUERYBUF:
      return queryBuffer(static_cast<v4l2_buffer *>(argument));
    case VIDIOC_QBUF:
      return queueBuffer(*static_cast<v4l2_buffer *>(argument));
    case VIDIOC_DQBUF:
      return dequeueBuffer(static_cast<v4l2_buffer *>(argument));
    case VIDIOC_STREAMON:
      return streamOn(now_ns);
    case VIDIOC_STREAMOFF:
      return streamOff();
    case VIDIOC_QUERY_EXT_CTRL:
      return queryControl(static_cast<v4l2_query_ext_ctrl *>(argument));
    case VIDIOC_G_EXT_CTRLS:
      return accessControl(false, static_cast<v4l2_ext_controls *>(argument));
    case VIDIOC_S_EXT_CTRLS:
      return accessControl(true, static_cast<v4l2_ext_controls *>(argument));
    case VIDIOC_SUBSCRIBE_EVENT:
      has_subscribed_ = true;
      return 0;
    case VIDIOC_DQEVENT:
      return dequeueEvent(static_cast<v4l2_event *>(argument));
    default:
      return ENOTTY;
  }
}

// ---- kernel ----------------------------------------------------------------------------------------------------

FakeKernel::FakeKernel() {
  const auto kernel = [](void *self) { return static_cast<FakeKernel *>(self); };
  static constexpr auto kernelOf = kernel;
  syscalls_ = {
      this,
      [](void *self, const char *path, int) { return kernelOf(self)->open(path); },
      [](void *self, int fd) { return kernelOf(self)->close(fd); },
      [](void *self, int fd, unsigned long request, void *arg) { return kernelOf(self)->ioctl(fd, request, arg); },
      [](void *self, size_t bytes, int, int, int fd, int64_t at) { return kernelOf(self)->mmap(bytes, fd, at); },
      [](void *self, void *memory, size_t bytes) { return kernelOf(self)->munmap(memory, bytes); },
      [](void *self, pollfd *file, int64_t timeout_ns) { return kernelOf(self)->poll(file, timeout_ns); },
      [](void *self) {
        kernelOf(self)->pass(kernelOf(self)->now_ns + kLookNs);
        return kernelOf(self)->now_ns;
      }};
}

std::shared_ptr<FakeCamera> FakeKernel::plugIn(uint32_t number, FakeCamera camera) {
  nodes_.at(number) = std::make_shared<FakeCamera>(std::move(camera));
  return nodes_[number];
}

void FakeKernel::unplug(uint32_t number) {
  if (!nodes_.at(number)) return;
  nodes_[number]->is_gone_ = true;  // who has it open still does
  nodes_[number].reset();
}

void FakeKernel::failCall(uint32_t call, int error) {
  fail_at_ = calls_ + call;
  fail_error_ = error;
}

void FakeKernel::unplugAtCall(uint32_t call) { unplug_at_ = calls_ + call; }

void FakeKernel::failRequest(unsigned long request, int error, uint32_t times) {
  failing_request_ = request;
  failing_error_ = error;
  failing_times_ = times;
}

int FakeKernel::interfere(unsigned long request) {
  const uint32_t call = calls_++;
  if (call == unplug_at_)
    for (uint32_t i = 0; i < nodes_.size(); ++i) unplug(i);
  if (call == fail_at_) return fail_error_;
  if (request != failing_request_ || failing_times_ == 0) return 0;
  --failing_times_;
  return failing_error_;
}

uint32_t FakeKernel::openFiles() const {
  return static_cast<uint32_t>(
      std::count_if(files_.begin(), files_.end(), [](const File &f) { return !!f.camera; }));
}

uint32_t FakeKernel::mappings() const {
  return static_cast<uint32_t>(
      std::count_if(mappings_.begin(), mappings_.end(), [](const Mapping &m) { return !!m.camera; }));
}

int32_t FakeKernel::openReads() const {
  int32_t reads = 0;
  for (const File &file : files_) reads += file.reads;
  return reads;
}

int FakeKernel::addFile(const std::shared_ptr<FakeCamera> &camera, int32_t buffer) {
  for (size_t i = 0; i < files_.size(); ++i) {
    if (files_[i].camera) continue;
    files_[i] = {camera, buffer, 0};
    return kFirstFile + static_cast<int>(i);
  }
  return failWith(EMFILE);
}

FakeKernel::File *FakeKernel::fileOf(int fd) {
  const size_t index = static_cast<size_t>(fd - kFirstFile);
  return index < files_.size() && files_[index].camera ? &files_[index] : nullptr;
}

void FakeKernel::pass(int64_t until_ns) {
  for (const auto &camera : nodes_)
    if (camera) camera->exposeUntil(until_ns);
  now_ns = until_ns;
}

int FakeKernel::open(const char *path) {
  if (const int error = interfere(kOpen)) return failWith(error);
  unsigned number = 0;
  if (std::sscanf(path, "/dev/video%u", &number) != 1 || number >= nodes_.size() || !nodes_[number])
    return failWith(ENOENT);
  return addFile(nodes_[number], -1);
}

int FakeKernel::close(int fd) {
  const int error = interfere(kClose);
  File *file = fileOf(fd);
  if (!file) return failWith(EBADF);
  if (file->buffer < 0) file->camera->streamOff();
  *file = {};
  return error ? failWith(error) : 0;  // it is closed all the same
}

int FakeKernel::syncBuffer(File *file, unsigned long request, const void *argument) {
  if (request != DMA_BUF_IOCTL_SYNC) return failWith(ENOTTY);
  const uint64_t flags = static_cast<const dma_buf_sync *>(argument)->flags;
  file->reads += (flags & DMA_BUF_SYNC_END) ? -1 : 1;
  return 0;
}

int FakeKernel::ioctl(int fd, unsigned long request, void *argument) {
  if (const int error = interfere(request)) return failWith(error);
  File *file = fileOf(fd);
  if (!file) return failWith(EBADF);
  if (file->buffer >= 0) return syncBuffer(file, request, argument);
  if (file->camera->is_gone_) return failWith(ENODEV);
  if (request == VIDIOC_EXPBUF) {
    auto *exported = static_cast<v4l2_exportbuffer *>(argument);
    if (exported->index >= file->camera->buffers_.size()) return failWith(EINVAL);
    exported->fd = addFile(file->camera, static_cast<int32_t>(exported->index));
    return exported->fd < 0 ? -1 : 0;
  }
  const int error = file->camera->ioctl(request, argument, now_ns);
  return error ? failWith(error) : 0;
}

void *FakeKernel::mmap(size_t bytes, int fd, int64_t offset) {
  const int error = interfere(kMmap);
  const File *file = fileOf(fd);
  const size_t index =
      file && file->buffer >= 0 ? static_cast<size_t>(file->buffer) : static_cast<size_t>(offset >> 20);
  const bool fits = file && index < file->camera->buffers_.size() && bytes <= file->camera->buffer_bytes_;
  const auto free = std::find_if(mappings_.begin(), mappings_.end(), [](const Mapping &m) { return !m.camera; });
  if (error || !fits || free == mappings_.end()) {
    errno = error ? error : EINVAL;
    return MAP_FAILED;
  }
  *free = {file->camera, file->camera->buffers_[index].data.get(), bytes};
  return free->memory;
}

int FakeKernel::munmap(void *memory, size_t bytes) {
  const int error = interfere(kMunmap);
  const auto it = std::find_if(mappings_.begin(), mappings_.end(), [&](const Mapping &m) {
    return m.camera && m.memory == memory && m.bytes == bytes;
  });
  if (it == mappings_.end()) return failWith(EINVAL);
  *it = {};
  return error ? failWith(error) : 0;
}

int FakeKernel::poll(pollfd *polled, int64_t timeout_ns) {
  if (const int error = interfere(kPoll)) return failWith(error);
  const File *file = fileOf(polled->fd);
  if (!file) return failWith(EBADF);
  FakeCamera &camera = *file->camera;
  const int64_t until_ns = now_ns + timeout_ns;
  for (;;) {
    polled->revents = 0;
    if (camera.is_gone_)
      polled->revents = POLLERR | POLLHUP | POLLPRI;
    else if (!camera.is_streaming_ || camera.is_given_up)
      polled->revents = POLLERR;
    if (camera.done_.count > 0) polled->revents |= POLLIN;
    if (camera.event_count_ > 0) polled->revents |= POLLPRI;
    if (polled->revents) return 1;
    if (now_ns >= until_ns) return 0;
    const bool comes = camera.is_streaming_ && !camera.is_stalled;
    pass(comes ? std::min(until_ns, camera.next_frame_ns_) : until_ns);
  }
}

}  // namespace sphc::test
