#include "fake_libcamera.h"

#include <cstdio>
#include <cstring>
#include <ctime>
#include <deque>
#include <memory>
#include <vector>

#include "drivers/libcamera/pixel_format.h"
#include "drivers/pixels/explain.h"

using namespace sphc::contract;
using sphc::pixels::explain;

struct sphc_libcamera_device {
  sphc_libcamera_mode mode = {};
  std::vector<std::vector<uint8_t>> buffers;
  std::deque<uint32_t> queued;
  uint32_t sequence = 0;
  bool running = false;
};

namespace {

FakeLibcamera &fake() {
  static FakeLibcamera state;
  return state;
}

constexpr const char *kIds[] = {"fake-one", "fake-two"};

const sphc::libcamera::PixelFormat &format() { return *sphc::libcamera::findPixelFormat(fake().pixel_format); }

int64_t nowNs() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * int64_t{1000000000} + now.tv_nsec;
}

void sleepUs(uint32_t us) {
  const timespec span = {us / 1000000, us % 1000000 * 1000L};
  nanosleep(&span, nullptr);
}

sphc_libcamera_name nameOf(uint32_t index) {
  sphc_libcamera_name name = {};
  std::snprintf(name.id, sizeof name.id, "%s", kIds[index]);
  std::snprintf(name.model, sizeof name.model, "Fake %u", index + 1);
  return name;
}

sphc_status list(sphc_libcamera_name *names, uint32_t capacity, uint32_t *count, sphc_message *) {
  for (uint32_t i = 0; i < capacity && i < 2; ++i) names[i] = nameOf(i);
  *count = 2;
  return SPHC_OK;
}

sphc_status open(const char *id, sphc_libcamera_device **device, sphc_libcamera_name *name, sphc_message *message) {
  for (uint32_t i = 0; i < 2; ++i) {
    if (id && std::strcmp(id, kIds[i]) != 0) continue;
    *name = nameOf(i);
    *device = new sphc_libcamera_device;
    ++fake().open_devices;
    return SPHC_OK;
  }
  return explain(message, SPHC_E_DEVICE, "no camera %s", id);
}

void stop(sphc_libcamera_device *device) {
  if (device->running) --fake().running_devices;
  device->running = false;
}

void close(sphc_libcamera_device *device) {
  stop(device);
  --fake().open_devices;
  delete device;
}

uint32_t formats(sphc_libcamera_device *, uint32_t *fourccs, uint32_t capacity) {
  if (capacity > 0) fourccs[0] = format().fourcc;
  return 1;
}

sphc_status configure(sphc_libcamera_device *device, sphc_libcamera_mode *mode, sphc_message *) {
  if (mode->width == 0) mode->width = 64, mode->height = 48;
  if (fake().other_width != 0) mode->width = fake().other_width;
  mode->stride_bytes = sphc::pixels::rowBytes(format().layout, mode->width) + 32;
  mode->buffers = fake().buffers;
  mode->full_range = 0;
  device->mode = *mode;
  const size_t rows = mode->height + (format().layout == sphc::pixels::Layout::Nv12 ? mode->height / 2 : 0);
  device->buffers.assign(mode->buffers, std::vector<uint8_t>(mode->stride_bytes * rows));
  return SPHC_OK;
}

// NV12 lies in two planes of one buffer, as libcamera gives it.
size_t firstPlaneBytes(const sphc_libcamera_device &device) {
  return size_t{device.mode.stride_bytes} * device.mode.height;
}

sphc_status buffer(const sphc_libcamera_device *device, uint32_t index, sphc_libcamera_buffer *buffer) {
  if (index >= device->buffers.size()) return SPHC_E_ARGUMENT;
  const std::vector<uint8_t> &bytes = device->buffers[index];
  const size_t first = firstPlaneBytes(*device);
  *buffer = {{bytes.data(), nullptr}, {first, 0}};
  if (bytes.size() > first) *buffer = {{bytes.data(), bytes.data() + first}, {first, bytes.size() - first}};
  return SPHC_OK;
}

FakeControl *findControl(const char *name) {
  for (FakeControl &control : fake().controls)
    if (control.name && std::strcmp(control.name, name) == 0) return &control;
  return nullptr;
}

sphc_status control(const sphc_libcamera_device *, const char *name, sphc_libcamera_range *range) {
  const FakeControl *found = findControl(name);
  if (!found) return SPHC_E_UNSUPPORTED;
  *range = {found->min, found->max};
  return SPHC_OK;
}

sphc_status set(sphc_libcamera_device *, const char *name, int64_t value) {
  FakeControl *found = findControl(name);
  if (!found || fake().refuses_settings) return SPHC_E_UNSUPPORTED;
  found->value = value;
  return SPHC_OK;
}

sphc_status start(sphc_libcamera_device *device, sphc_message *message) {
  if (fake().unplugged) return explain(message, SPHC_E_DEVICE_LOST, "unplugged");
  if (fake().cannot_start) return explain(message, SPHC_E_DEVICE, "no bandwidth");
  device->queued.clear();
  for (uint32_t i = 0; i < device->buffers.size(); ++i) device->queued.push_back(i);
  device->sequence = 0;
  device->running = true;
  ++fake().running_devices;
  return SPHC_OK;
}

void fill(const sphc_libcamera_device &device, std::vector<uint8_t> &bytes) {
  for (size_t i = 0; i < bytes.size(); ++i)
    bytes[i] = static_cast<uint8_t>(16 + (3 * i + 7 * device.sequence) % 200);
}

sphc_status wait(sphc_libcamera_device *device, uint32_t timeout_us, sphc_libcamera_frame *frame,
                 sphc_message *message) {
  if (fake().unplugged) return explain(message, SPHC_E_DEVICE_LOST, "unplugged");
  if (fake().refuses_next) {
    fake().refuses_next = false;
    return explain(message, SPHC_E_DEVICE, "refused a buffer or a control");
  }
  if (fake().stalled || device->queued.empty()) {
    sleepUs(timeout_us);
    return SPHC_AGAIN;
  }
  *frame = {};
  frame->buffer = device->queued.front();
  device->queued.pop_front();
  device->sequence += fake().skip;
  fake().skip = 0;
  std::vector<uint8_t> &bytes = device->buffers[frame->buffer];
  fill(*device, bytes);
  frame->sequence = device->sequence++;
  frame->damaged = fake().next_damaged;
  fake().next_damaged = false;
  frame->used_bytes[0] = firstPlaneBytes(*device) - fake().missing_bytes;
  frame->used_bytes[1] = bytes.size() - firstPlaneBytes(*device);
  fake().missing_bytes = 0;
  frame->sensor_time_ns = fake().gives_time ? nowNs() + fake().time_shift_ns : 0;
  frame->exposure_us = fake().exposure_us;
  return SPHC_OK;
}

void queue(sphc_libcamera_device *device, uint32_t index) { device->queued.push_back(index); }

}  // namespace

extern "C" {

__attribute__((visibility("default"))) const sphc_libcamera_plugin *sphc_libcamera_plugin_entry(uint32_t version) {
  static const sphc_libcamera_plugin table = {SPHC_LIBCAMERA_PLUGIN_VERSION,
                                              "fake",
                                              list,
                                              open,
                                              close,
                                              formats,
                                              configure,
                                              buffer,
                                              control,
                                              set,
                                              start,
                                              wait,
                                              queue,
                                              stop};
  return version == SPHC_LIBCAMERA_PLUGIN_VERSION && fake().speaks_our_version ? &table : nullptr;
}

__attribute__((visibility("default"))) FakeLibcamera *sphc_fake_libcamera() { return &fake(); }

}  // extern "C"
