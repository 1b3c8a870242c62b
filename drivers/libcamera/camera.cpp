#include "camera.h"

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "drivers/pixels/convert.h"
#include "drivers/pixels/explain.h"

namespace sphc::libcamera {

using pixels::explain;

Camera::~Camera() {
  stop();
  if (device_) plugin_.close(device_);
}

sphc_status Camera::open(const char *id, sphc_message *message) {
  sphc_status status = plugin_.open(id, &device_, &name_, message);
  if (status == SPHC_OK) status = setUp(plugin_, device_, config_, &setup_, message);
  if (status != SPHC_OK) return status;
  buffers_.resize(setup_.mode.buffers);
  for (uint32_t i = 0; i < setup_.mode.buffers; ++i)
    if (plugin_.buffer(device_, i, &buffers_[i]) != SPHC_OK)
      return explain(message, SPHC_E_DEVICE, "%s: buffer %u is missing; open the camera again", name_.id, i);
  if (!decoder_.isReady()) return explain(message, SPHC_E_DEVICE, "out of memory for a JPEG decoder; free some");
  slots_.resize(config_.loan_limit);
  for (Slot &slot : slots_) slot.pixels.reset(new uint8_t[imageOf(slot).bytes]());
  clock_ = FrameClock(config_.rate_hz == 0 ? 0 : 1000000000 / config_.rate_hz);
  return SPHC_OK;
}

void Camera::describe(sphc_libcamera_info *info) const {
  *info = {};
  info->struct_size = sizeof *info;
  info->width = setup_.mode.width;
  info->height = setup_.mode.height;
  std::memcpy(info->pixel_format, setup_.format->name, sizeof info->pixel_format);
  std::snprintf(info->library, sizeof info->library, "%s", plugin_.library);
  info->name = name_;
  info->exposure_min_us = static_cast<uint32_t>(setup_.exposure_us.min);
  info->exposure_max_us = static_cast<uint32_t>(setup_.exposure_us.max);
  info->lost = lost_;
  info->refused = refused_;
  info->without_time = without_time_;
}

sphc_status Camera::start() {
  if (running_) return explain(&message_, SPHC_E_STATE, "start: running already; call stop first");
  clock_.restart(readHostClocks());
  const sphc_status status = plugin_.start(device_, &message_);
  if (status != SPHC_OK) return status;
  running_ = true;
  set_exposure_us_ = config_.exposure_us;
  any_ = false;
  lost_ = refused_ = without_time_ = 0;
  return SPHC_OK;
}

void Camera::stop() {
  if (!running_) return;
  running_ = false;
  plugin_.stop(device_);
  for (Slot &slot : slots_) slot.token = 0;
}

pixels::OutImage Camera::imageOf(const Slot &slot) const {
  const uint32_t stride_bytes = setup_.mode.width * sphc_format_bytes(config_.format);
  return {slot.pixels.get(), size_t{stride_bytes} * setup_.mode.height,
          setup_.mode.width, setup_.mode.height,
          stride_bytes,      config_.format};
}

// Numbers that stand still or go back (a defect of the kernel's driver) count on by one: none comes twice.
void Camera::count(uint32_t sequence) {
  if (!any_) {
    sequence_ = sequence;
  } else {
    const uint32_t step = sequence - sequence_;
    const bool is_ahead = step != 0 && step < UINT32_MAX / 2;
    lost_ += is_ahead ? step - 1 : 0;
    sequence_ = is_ahead ? sequence : sequence_ + 1;
  }
  any_ = true;
}

sphc_status Camera::refuse(const sphc_libcamera_frame &frame) {
  ++refused_;
  plugin_.queue(device_, frame.buffer);
  return SPHC_E_DEVICE;
}

sphc_status Camera::convertInto(const Slot &slot, const sphc_libcamera_frame &frame) {
  const sphc_libcamera_buffer &buffer = buffers_[frame.buffer];
  const sphc_libcamera_mode &mode = setup_.mode;
  const auto used = [&](int plane) {  // what is mapped fits a size_t
    return static_cast<size_t>(std::min(frame.used_bytes[plane], buffer.bytes[plane]));
  };
  const pixels::OutImage out = imageOf(slot);
  if (setup_.format->is_jpeg) return decoder_.decode(buffer.data[0], used(0), out, &message_);
  const pixels::YuvRange range = mode.full_range ? pixels::YuvRange::Full : pixels::YuvRange::Limited;
  pixels::RawImage raw = pixels::contiguous(setup_.format->layout, range, mode.width, mode.height,
                                            mode.stride_bytes, buffer.data[0], used(0));
  if (buffer.data[1]) raw.planes[1] = {buffer.data[1], used(1), mode.stride_bytes};
  return pixels::convert(raw, out, &message_);
}

sphc_status Camera::acquire(uint32_t timeout_us, sphc_capture *capture) {
  if (!capture) return explain(&message_, SPHC_E_ARGUMENT, "acquire: capture is null; give one");
  if (capture->struct_size != sizeof *capture)
    return explain(&message_, SPHC_E_STRUCT_SIZE, "acquire: set capture.struct_size to sizeof(sphc_capture)");
  if (!running_) return explain(&message_, SPHC_E_STATE, "acquire: not running; call start first");
  const auto free_slot =
      std::find_if(slots_.begin(), slots_.end(), [](const Slot &slot) { return slot.token == 0; });
  if (free_slot == slots_.end())
    return explain(&message_, SPHC_E_STATE, "acquire: %u captures are on loan, the limit; release one first",
                   config_.loan_limit);
  sphc_libcamera_frame frame;
  const sphc_status status = plugin_.wait(device_, timeout_us, &frame, &message_);
  if (status == SPHC_E_DEVICE) set_exposure_us_ = 0;  // may be what was refused
  if (status != SPHC_OK) return status;
  const HostClocks now = readHostClocks();
  if (frame.buffer >= buffers_.size())
    return explain(&message_, SPHC_E_DEVICE, "buffer %u of %zu", frame.buffer, buffers_.size());
  count(frame.sequence);
  if (frame.damaged) {
    explain(&message_, SPHC_E_DEVICE, "frame %u: damaged on its way; look at cable, hub and bandwidth",
            frame.sequence);
    return refuse(frame);
  }
  const int64_t exposure_us = frame.exposure_us > 0 ? frame.exposure_us : set_exposure_us_;
  const FrameTime time = clock_.frameTime(frame.sensor_time_ns, exposure_us, now);
  if (time.time_ns <= last_ns_) {
    explain(&message_, SPHC_E_DEVICE, "frame %u: its time lies %.3f ms before that of the last one; take the next",
            frame.sequence, static_cast<double>(last_ns_ - time.time_ns) * 1e-6);
    return refuse(frame);
  }
  if (convertInto(*free_slot, frame) != SPHC_OK) return refuse(frame);
  plugin_.queue(device_, frame.buffer);

  last_ns_ = time.time_ns;
  without_time_ += time.point == SPHC_TIME_ARRIVAL;
  free_slot->token = ++last_token_;
  *capture = {};
  capture->struct_size = sizeof *capture;
  capture->stream = SPHC_STREAM_COLOR;
  capture->time_ns = time.time_ns;
  capture->token = free_slot->token;
  capture->sequence = sequence_;
  capture->time_point = time.point;
  const pixels::OutImage image = imageOf(*free_slot);
  capture->image = {image.data, image.width, image.height, image.stride_bytes, image.format};
  capture->arrival_ns = now.monotonic_ns;
  capture->exposure_us = static_cast<uint32_t>(time.point == SPHC_TIME_MIDDLE ? exposure_us : 0);
  capture->time_sigma_us = time.sigma_us;
  capture->clock = SPHC_CLOCK_MONOTONIC;
  return SPHC_OK;
}

void Camera::release(const sphc_capture &capture) {
  if (capture.token == 0) return;
  for (Slot &slot : slots_)
    if (slot.token == capture.token && slot.pixels.get() == capture.image.data) slot.token = 0;
}

}  // namespace sphc::libcamera
