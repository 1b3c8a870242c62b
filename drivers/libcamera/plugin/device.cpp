#include "device.h"

#include <chrono>
#include <cstdio>
#include <cstring>
#include <utility>

#include "drivers/pixels/explain.h"
#include "releases.h"

namespace sphc::libcamera_plugin {

using namespace libcamera;

namespace {

std::string errorText(int error) { return std::strerror(error < 0 ? -error : error); }

void copyText(char *out, size_t room, const std::string &text) { std::snprintf(out, room, "%s", text.c_str()); }

[[noreturn]] void refuse(sphc_status status, const std::string &text) { throw Refusal{status, text}; }

// `value` as whatever the control is made of.  A duration limit is a pair: both ends alike.
ControlValue valueOfType(const ControlId &id, int64_t value) {
  if (id.name() == "FrameDurationLimits") {
    const int64_t limits[2] = {value, value};
    return ControlValue(Span<const int64_t, 2>(limits));
  }
  switch (id.type()) {
    case ControlTypeBool:
      return ControlValue(value != 0);
    case ControlTypeInteger32:
      return ControlValue(static_cast<int32_t>(value));
    case ControlTypeInteger64:
      return ControlValue(value);
    default:
      refuse(SPHC_E_UNSUPPORTED, id.name() + ": a control of a type unknown here");
  }
}

int64_t numberOf(const ControlValue &value, int64_t other) {
  switch (value.type()) {
    case ControlTypeBool:
      return value.get<bool>() ? 1 : 0;
    case ControlTypeInteger32:
      return value.get<int32_t>();
    case ControlTypeInteger64:
      return value.isArray() ? other : value.get<int64_t>();
    default:
      return other;
  }
}

}  // namespace

std::shared_ptr<CameraManager> sharedManager() {
  static std::mutex mutex;
  static CameraManager *manager = nullptr;
  static uint32_t users = 0;
  // There may be one manager only, until its destructor has ended: it is made and ended under the lock.
  struct User {
    User() {
      const std::lock_guard<std::mutex> lock(mutex);
      if (users == 0) {
        auto made = std::make_unique<CameraManager>();
        const int error = made->start();
        if (error) refuse(SPHC_E_DEVICE, "libcamera does not start: " + errorText(error));
        manager = made.release();
      }
      ++users;
    }
    ~User() {
      const std::lock_guard<std::mutex> lock(mutex);
      if (--users > 0) return;
      delete manager;
      manager = nullptr;
    }
  };
  const auto user = std::make_shared<User>();
  return {user, manager};
}

sphc_libcamera_name nameOf(const Camera &camera) {
  sphc_libcamera_name name = {};
  copyText(name.id, sizeof name.id, camera.id());
  const auto model = camera.properties().get(properties::Model);
  if (model) copyText(name.model, sizeof name.model, std::string(*model));
  return name;
}

// What fails here is undone by the destructor, since Device() has ended.
Device::Device(const char *id) : Device() {
  const std::shared_ptr<Camera> camera = find(id);
  id_ = camera->id();
  const int error = camera->acquire();
  if (error) refuse(SPHC_E_DEVICE, id_ + ": " + errorText(error) + "; another program has it");
  camera_ = camera;
  camera_->requestCompleted.connect(this, &Device::completed);
  camera_->disconnected.connect(this, &Device::disconnected);
}

std::shared_ptr<Camera> Device::find(const char *id) const {
  const std::vector<std::shared_ptr<Camera>> cameras = manager_->cameras();
  for (const std::shared_ptr<Camera> &camera : cameras)
    if (!id || camera->id() == id) return camera;
  const std::string which =
      id ? "no camera " + std::string(id) + " of " + std::to_string(cameras.size()) : "no camera was found";
  refuse(SPHC_E_DEVICE, which + "; is it plugged in, and may this user read /dev/video* and /dev/media*?");
}

Device::~Device() {
  if (!camera_) return;
  stop();
  freeBuffers();
  camera_->requestCompleted.disconnect(this);
  camera_->disconnected.disconnect(this);
  camera_->release();
}

std::vector<PixelFormat> Device::formats() const {
  const auto configuration = camera_->generateConfiguration({StreamRole::Viewfinder});
  return configuration && !configuration->empty() ? configuration->at(0).formats().pixelformats()
                                                  : std::vector<PixelFormat>{};
}

void Device::configure(sphc_libcamera_mode &mode) {
  freeBuffers();
  configuration_ = camera_->generateConfiguration({StreamRole::Viewfinder});
  if (!configuration_ || configuration_->empty()) refuse(SPHC_E_UNSUPPORTED, id_ + ": has no video stream");
  StreamConfiguration &stream = configuration_->at(0);
  stream.pixelFormat = PixelFormat(mode.fourcc);
  if (mode.width != 0) stream.size = Size(mode.width, mode.height);
  stream.bufferCount = mode.buffers;
  if (configuration_->validate() == CameraConfiguration::Invalid)
    refuse(SPHC_E_UNSUPPORTED, id_ + ": no such configuration: " + stream.toString());
  const int error = camera_->configure(configuration_.get());
  if (error) refuse(SPHC_E_DEVICE, id_ + ": " + stream.toString() + ": " + errorText(error));
  makeRequests();
  mode = {stream.pixelFormat.fourcc(),
          stream.size.width,
          stream.size.height,
          stream.stride,
          static_cast<uint32_t>(requests_.size()),
          stream.colorSpace && stream.colorSpace->range == ColorSpace::Range::Full};
}

void Device::makeRequests() {
  Stream *stream = configuration_->at(0).stream();
  allocator_ = std::make_unique<FrameBufferAllocator>(camera_);
  const int count = allocator_->allocate(stream);
  if (count < 0) refuse(SPHC_E_DEVICE, id_ + ": no buffers: " + errorText(count));
  for (const std::unique_ptr<FrameBuffer> &buffer : allocator_->buffers(stream)) {
    if (requests_.size() == SPHC_LIBCAMERA_BUFFERS_MAX) break;
    MappedBuffer mapped;
    if (!mapped.map(*buffer)) refuse(SPHC_E_DEVICE, id_ + ": buffers cannot be read: " + errorText(errno));
    mapped_.push_back(std::move(mapped));
    requests_.push_back(camera_->createRequest(requests_.size()));
    if (!requests_.back() || requests_.back()->addBuffer(stream, buffer.get()) != 0)
      refuse(SPHC_E_DEVICE, id_ + ": no request for a buffer");
  }
}

void Device::freeBuffers() {
  requests_.clear();
  mapped_.clear();
  allocator_.reset();
}

sphc_libcamera_range Device::control(const char *control_name) const {
  const ControlId *id = findControl(camera_->controls(), control_name);
  if (!id) refuse(SPHC_E_UNSUPPORTED, id_ + ": has no control " + control_name);
  const ControlInfo &info = camera_->controls().at(id);
  return {numberOf(info.min(), INT64_MIN), numberOf(info.max(), INT64_MAX)};
}

void Device::set(const char *control_name, int64_t value) {
  const ControlId *id = findControl(camera_->controls(), control_name);
  if (!id) refuse(SPHC_E_UNSUPPORTED, id_ + ": has no control " + control_name);
  settings_.emplace_back(id->id(), valueOfType(*id, value));
}

void Device::start() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (lost_) refuse(SPHC_E_DEVICE_LOST, id_ + ": was unplugged; close it and open it again");
    first_done_ = done_count_ = 0;
    queue_error_ = 0;
    is_back_ = {};
    stopping_ = false;
  }
  const int error = camera_->start();
  if (error) refuse(SPHC_E_DEVICE, id_ + ": does not start: " + errorText(error));
  running_ = true;
  for (size_t i = 0; i < requests_.size(); ++i) {
    mapped_[i].endReading();
    requests_[i]->reuse(Request::ReuseBuffers);
    if (i == 0)  // some handlers ignore the controls of start
      for (const auto &[id, value] : settings_) requests_[i]->controls().set(id, value);
    const int refused = camera_->queueRequest(requests_[i].get());
    if (refused) {
      stop();
      refuse(SPHC_E_DEVICE, id_ + ": takes no buffer: " + errorText(refused));
    }
  }
}

void Device::completed(Request *request) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (request->status() ==
      Request::RequestCancelled) {  // by stop, or since the kernel refused a buffer or a control
    if (stopping_) return;
    is_back_[request->cookie()] = true;
    queue_error_ = -ECANCELED;
    changed_.notify_one();
    return;
  }
  done_[(first_done_ + done_count_) % SPHC_LIBCAMERA_BUFFERS_MAX] = static_cast<uint32_t>(request->cookie());
  ++done_count_;
  changed_.notify_one();
}

void Device::disconnected() {
  const std::lock_guard<std::mutex> lock(mutex_);
  lost_ = true;
  changed_.notify_one();
}

sphc_status Device::wait(uint32_t timeout_us, sphc_libcamera_frame &frame, sphc_message *message) {
  std::unique_lock<std::mutex> lock(mutex_);
  const auto is_news = [this] { return done_count_ > 0 || lost_ || queue_error_ != 0; };
  if (!changed_.wait_for(lock, std::chrono::microseconds(timeout_us), is_news)) return SPHC_AGAIN;
  if (lost_)
    return pixels::explain(message, SPHC_E_DEVICE_LOST, "%s: was unplugged; stop, close, and open it again",
                           id_.c_str());
  if (queue_error_ != 0) {
    const int error = std::exchange(queue_error_, 0);
    const auto back = std::exchange(is_back_, {});
    lock.unlock();
    for (uint32_t buffer = 0; buffer < requests_.size(); ++buffer)
      if (back[buffer]) queue(buffer);  // without controls
    return pixels::explain(message, SPHC_E_DEVICE,
                           "%s: the camera refused a buffer or a control, such as the exposure (error %d)",
                           id_.c_str(), error);
  }
  const uint32_t index = done_[first_done_];
  first_done_ = (first_done_ + 1) % SPHC_LIBCAMERA_BUFFERS_MAX;
  --done_count_;
  lock.unlock();

  const Request &request = *requests_[index];
  const FrameMetadata &metadata = request.buffers().begin()->second->metadata();
  mapped_[index].beginReading();
  frame = {};
  frame.buffer = index;
  frame.sequence = metadata.sequence;
  // Later releases also know whole frames of a sensor that is still starting.
  frame.damaged = metadata.status == FrameMetadata::FrameError || metadata.status == FrameMetadata::FrameCancelled;
  size_t plane = 0;
  for (const auto &used : metadata.planes())
    if (plane < 2) frame.used_bytes[plane++] = used.bytesused;
  const ControlList &told = const_cast<Request &>(request).metadata();
  frame.sensor_time_ns = told.get(controls::SensorTimestamp).value_or(static_cast<int64_t>(metadata.timestamp));
  frame.exposure_us = told.get(controls::ExposureTime).value_or(0);
  return SPHC_OK;
}

void Device::queue(uint32_t buffer) {
  if (!running_ || buffer >= requests_.size()) return;
  mapped_[buffer].endReading();
  requests_[buffer]->reuse(Request::ReuseBuffers);
  const int error = camera_->queueRequest(requests_[buffer].get());
  if (error == 0) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  queue_error_ = error;
  is_back_[buffer] = true;
}

void Device::stop() {
  if (!running_) return;
  running_ = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  camera_->stop();  // gives every request back, cancelled
}

}  // namespace sphc::libcamera_plugin
