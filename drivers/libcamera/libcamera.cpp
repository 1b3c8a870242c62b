// The C functions over Camera.
#include "libcamera.h"

#include <new>

#include "camera.h"
#include "drivers/pixels/explain.h"
#include "plugin_loader.h"

using sphc::libcamera::Camera;
using sphc::pixels::explain;

struct sphc_libcamera {
  Camera camera;
};

namespace {

constexpr uint32_t kMostLoans = 64;

sphc_status checkConfig(const sphc_libcamera_config &config, sphc_message *message) {
  if (config.format != SPHC_FORMAT_BGR8 && config.format != SPHC_FORMAT_RGB8 && config.format != SPHC_FORMAT_GRAY8)
    return explain(message, SPHC_E_ARGUMENT, "config.format %d; give BGR8, RGB8 or GRAY8", config.format);
  const auto is_side = [](uint32_t side) { return side >= SPHC_CAMERA_MIN_PX && side <= SPHC_CAMERA_MAX_PX; };
  if ((config.width || config.height) && !(is_side(config.width) && is_side(config.height)))
    return explain(message, SPHC_E_ARGUMENT, "config size %u x %u; both must be %u to %u, or both 0", config.width,
                   config.height, SPHC_CAMERA_MIN_PX, SPHC_CAMERA_MAX_PX);
  if (config.rate_hz > 1000)
    return explain(message, SPHC_E_ARGUMENT, "config.rate_hz %u; it must be 0 to 1000", config.rate_hz);
  if (config.exposure_us > 10000000)
    return explain(message, SPHC_E_ARGUMENT, "config.exposure_us %u; it must be 0 to 10000000", config.exposure_us);
  if (config.loan_limit < 2 || config.loan_limit > kMostLoans)
    return explain(message, SPHC_E_ARGUMENT, "config.loan_limit %u; it must be 2 to %u", config.loan_limit,
                   kMostLoans);
  if (config.pixel_format && !sphc::libcamera::findPixelFormat(config.pixel_format))
    return explain(message, SPHC_E_ARGUMENT,
                   "config.pixel_format %.16s; known are RG24 BG24 XR24 YUYV UYVY NV12 R8 MJPG",
                   config.pixel_format);
  return SPHC_OK;
}

Camera *cameraOf(void *self) { return &static_cast<sphc_libcamera *>(self)->camera; }

sphc_status start(void *self) { return self ? cameraOf(self)->start() : SPHC_E_ARGUMENT; }
sphc_status acquire(void *self, uint32_t timeout_us, sphc_capture *capture) {
  return self ? cameraOf(self)->acquire(timeout_us, capture) : SPHC_E_ARGUMENT;
}
void release(void *self, const sphc_capture *capture) {
  if (self && capture) cameraOf(self)->release(*capture);
}
void stop(void *self) {
  if (self) cameraOf(self)->stop();
}
const char *message(const void *self) {
  return self ? static_cast<const sphc_libcamera *>(self)->camera.message() : "self is null";
}

}  // namespace

extern "C" {

sphc_status sphc_libcamera_list(const char *plugin_path, sphc_libcamera_name *names, uint32_t capacity,
                                uint32_t *count, sphc_message *message) {
  if (!count || (!names && capacity > 0))
    return explain(message, SPHC_E_ARGUMENT, "names or count is null; give both");
  const sphc_libcamera_plugin *plugin = sphc::libcamera::loadPlugin(plugin_path, message);
  return plugin ? plugin->list(names, capacity, count, message) : SPHC_E_UNSUPPORTED;
}

sphc_status sphc_libcamera_config_init(sphc_libcamera_config *config, size_t struct_size) {
  if (!config) return SPHC_E_ARGUMENT;
  if (struct_size != sizeof *config) return SPHC_E_STRUCT_SIZE;
  *config = {};
  config->struct_size = sizeof *config;
  config->format = SPHC_FORMAT_BGR8;
  config->width = 640;
  config->height = 480;
  config->loan_limit = 8;
  return SPHC_OK;
}

sphc_status sphc_libcamera_open(const char *id, const sphc_libcamera_config *config, sphc_libcamera **camera,
                                sphc_message *message) try {
  if (!camera) return explain(message, SPHC_E_ARGUMENT, "camera is null; give a pointer to set");
  if (config && config->struct_size != sizeof *config)
    return explain(message, SPHC_E_STRUCT_SIZE, "config.struct_size %u: must be %zu", config->struct_size,
                   sizeof *config);
  sphc_libcamera_config chosen;
  sphc_libcamera_config_init(&chosen, sizeof chosen);
  if (config) chosen = *config;
  sphc_status status = checkConfig(chosen, message);
  if (status != SPHC_OK) return status;
  const sphc_libcamera_plugin *plugin = sphc::libcamera::loadPlugin(chosen.plugin_path, message);
  if (!plugin) return SPHC_E_UNSUPPORTED;
  std::unique_ptr<sphc_libcamera> opened(new sphc_libcamera{{*plugin, chosen}});
  status = opened->camera.open(id, message);
  if (status != SPHC_OK) return status;
  *camera = opened.release();
  return SPHC_OK;
} catch (const std::bad_alloc &) {
  return explain(message, SPHC_E_DEVICE, "out of memory; free some");
}

void sphc_libcamera_close(sphc_libcamera **camera) {
  if (!camera) return;
  delete *camera;
  *camera = nullptr;
}

sphc_status sphc_libcamera_get_info(const sphc_libcamera *camera, sphc_libcamera_info *info) {
  if (!camera || !info) return SPHC_E_ARGUMENT;
  if (info->struct_size != sizeof *info) return SPHC_E_STRUCT_SIZE;
  camera->camera.describe(info);
  return SPHC_OK;
}

sphc_status sphc_libcamera_source(sphc_libcamera *camera, sphc_source *source) {
  if (!camera || !source) return SPHC_E_ARGUMENT;
  *source = {sizeof *source, camera->camera.loanLimit(), camera, start, acquire, release, stop, message};
  return SPHC_OK;
}

}  // extern "C"
