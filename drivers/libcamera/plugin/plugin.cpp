// The table over Device.  Exceptions end here.
#include "../plugin.h"

#include <exception>
#include <memory>

#include "device.h"
#include "drivers/pixels/explain.h"

namespace sphc::libcamera_plugin {

namespace {

Device *deviceOf(sphc_libcamera_device *device) { return reinterpret_cast<Device *>(device); }
const Device *deviceOf(const sphc_libcamera_device *device) { return reinterpret_cast<const Device *>(device); }

template <typename Call>
sphc_status guarded(sphc_message *message, Call call) {
  try {
    return call();
  } catch (const Refusal &refusal) {
    return pixels::explain(message, refusal.status, "%s", refusal.text.c_str());
  } catch (const std::exception &error) {
    return pixels::explain(message, SPHC_E_DEVICE, "%s", error.what());
  }
}

sphc_status list(sphc_libcamera_name *names, uint32_t capacity, uint32_t *count, sphc_message *message) {
  return guarded(message, [&]() -> sphc_status {
    const std::shared_ptr<libcamera::CameraManager> manager = sharedManager();
    uint32_t i = 0;
    for (const std::shared_ptr<libcamera::Camera> &camera : manager->cameras()) {
      if (i < capacity) names[i] = nameOf(*camera);
      ++i;
    }
    *count = i;
    return SPHC_OK;
  });
}

sphc_status open(const char *id, sphc_libcamera_device **device, sphc_libcamera_name *name, sphc_message *message) {
  return guarded(message, [&]() -> sphc_status {
    auto opened = std::make_unique<Device>(id);
    *name = opened->name();
    *device = reinterpret_cast<sphc_libcamera_device *>(opened.release());
    return SPHC_OK;
  });
}

void close(sphc_libcamera_device *device) { delete deviceOf(device); }

uint32_t formats(sphc_libcamera_device *device, uint32_t *fourccs, uint32_t capacity) {
  uint32_t count = 0;
  guarded(nullptr, [&]() -> sphc_status {
    for (const libcamera::PixelFormat &format : deviceOf(device)->formats()) {
      if (count < capacity) fourccs[count] = format.fourcc();
      ++count;
    }
    return SPHC_OK;
  });
  return count;
}

sphc_status configure(sphc_libcamera_device *device, sphc_libcamera_mode *mode, sphc_message *message) {
  return guarded(message, [&]() -> sphc_status {
    deviceOf(device)->configure(*mode);
    return SPHC_OK;
  });
}

sphc_status buffer(const sphc_libcamera_device *device, uint32_t index, sphc_libcamera_buffer *buffer) {
  if (index >= deviceOf(device)->buffers().size()) return SPHC_E_ARGUMENT;
  *buffer = deviceOf(device)->buffers()[index].planes();
  return SPHC_OK;
}

sphc_status control(const sphc_libcamera_device *device, const char *name, sphc_libcamera_range *range) {
  return guarded(nullptr, [&]() -> sphc_status {
    *range = deviceOf(device)->control(name);
    return SPHC_OK;
  });
}

sphc_status set(sphc_libcamera_device *device, const char *name, int64_t value) {
  return guarded(nullptr, [&]() -> sphc_status {
    deviceOf(device)->set(name, value);
    return SPHC_OK;
  });
}

sphc_status start(sphc_libcamera_device *device, sphc_message *message) {
  return guarded(message, [&]() -> sphc_status {
    deviceOf(device)->start();
    return SPHC_OK;
  });
}

sphc_status wait(sphc_libcamera_device *device, uint32_t timeout_us, sphc_libcamera_frame *frame,
                 sphc_message *message) {
  return guarded(message, [&] { return deviceOf(device)->wait(timeout_us, *frame, message); });
}

void queue(sphc_libcamera_device *device, uint32_t index) { deviceOf(device)->queue(index); }
void stop(sphc_libcamera_device *device) { deviceOf(device)->stop(); }

}  // namespace

}  // namespace sphc::libcamera_plugin

extern "C" __attribute__((visibility("default"))) const sphc_libcamera_plugin *sphc_libcamera_plugin_entry(
    uint32_t version) {
  using namespace sphc::libcamera_plugin;
  static const sphc_libcamera_plugin table = {SPHC_LIBCAMERA_PLUGIN_VERSION,
                                              libcamera::CameraManager::version().c_str(),
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
  return version == SPHC_LIBCAMERA_PLUGIN_VERSION ? &table : nullptr;
}
