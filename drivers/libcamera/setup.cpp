#include "setup.h"

#include <algorithm>

#include "drivers/pixels/convert.h"
#include "drivers/pixels/explain.h"

namespace sphc::libcamera {

using pixels::explain;

namespace {

constexpr uint32_t kMostFormats = 64;
constexpr uint32_t kBuffers = 8;  // handlers may give others: the one for UVC cameras always gives 4

// The format that the config names, else the first that we prefer and the camera has.
const PixelFormat *chooseFormat(const sphc_libcamera_plugin &plugin, sphc_libcamera_device *device,
                                const sphc_libcamera_config &config) {
  uint32_t offered[kMostFormats];
  const uint32_t *end = offered + std::min(plugin.formats(device, offered, kMostFormats), kMostFormats);
  for (const PixelFormat &format : kPixelFormats) {
    if (config.pixel_format && findPixelFormat(config.pixel_format) != &format) continue;
    if (std::find<const uint32_t *>(offered, end, format.fourcc) != end) return &format;
  }
  return nullptr;
}

sphc_status chooseMode(const sphc_libcamera_plugin &plugin, sphc_libcamera_device *device,
                       const sphc_libcamera_config &config, Setup *setup, sphc_message *message) {
  setup->format = chooseFormat(plugin, device, config);
  if (!setup->format)
    return explain(
        message, SPHC_E_UNSUPPORTED,
        "pixel format %s: the camera has none such; known here are RG24 BG24 XR24 YUYV UYVY NV12 R8 MJPG, and "
        "`cam -c1 -I` lists what it has",
        config.pixel_format ? config.pixel_format : "(any)");
  sphc_libcamera_mode &mode = setup->mode;
  mode = {setup->format->fourcc, config.width, config.height, 0, kBuffers, 0};
  const sphc_status status = plugin.configure(device, &mode, message);
  if (status < 0) return status;
  if (mode.fourcc != setup->format->fourcc)
    return explain(message, SPHC_E_UNSUPPORTED, "pixel format %s: the camera would send another; ask for %.4s",
                   setup->format->name, reinterpret_cast<const char *>(&mode.fourcc));
  if (config.width != 0 && (mode.width != config.width || mode.height != config.height))
    return explain(message, SPHC_E_UNSUPPORTED,
                   "size %u x %u: the camera would send %u x %u in %s; ask for that, or 0 x 0", config.width,
                   config.height, mode.width, mode.height, setup->format->name);
  if (std::min(mode.width, mode.height) < SPHC_CAMERA_MIN_PX ||
      std::max(mode.width, mode.height) > SPHC_CAMERA_MAX_PX)
    return explain(message, SPHC_E_UNSUPPORTED, "size %u x %u: must be %u to %u", mode.width, mode.height,
                   SPHC_CAMERA_MIN_PX, SPHC_CAMERA_MAX_PX);
  if (mode.buffers < 2 || mode.buffers > SPHC_LIBCAMERA_BUFFERS_MAX)
    return explain(message, SPHC_E_DEVICE, "libcamera gives %u buffers; 2 to %u are needed", mode.buffers,
                   SPHC_LIBCAMERA_BUFFERS_MAX);
  return SPHC_OK;
}

// Who decides on the exposure: ExposureTimeMode since libcamera 0.5, AeEnable before; later releases ignore that
// for some cameras though they offer it.
void setAutomatic(const sphc_libcamera_plugin &plugin, sphc_libcamera_device *device, bool automatic) {
  if (plugin.set(device, "ExposureTimeMode", automatic ? 0 : 1) != SPHC_OK)
    plugin.set(device, "AeEnable", automatic ? 1 : 0);  // a camera with neither has nothing that decides
}

sphc_status chooseExposure(const sphc_libcamera_plugin &plugin, sphc_libcamera_device *device,
                           const sphc_libcamera_config &config, Setup *setup, sphc_message *message) {
  sphc_libcamera_range &range = setup->exposure_us;
  if (plugin.control(device, "ExposureTime", &range) != SPHC_OK) range = {};
  range.min = std::clamp<int64_t>(range.min, 0, UINT32_MAX);
  range.max = std::clamp<int64_t>(range.max, 0, UINT32_MAX);
  setAutomatic(plugin, device, config.exposure_us == 0);
  if (config.exposure_us == 0) return SPHC_OK;
  if (range.max == 0)
    return explain(message, SPHC_E_UNSUPPORTED, "exposure_us %u: this camera's exposure cannot be set; use 0",
                   config.exposure_us);
  if (config.exposure_us < range.min || config.exposure_us > range.max)
    return explain(message, SPHC_E_UNSUPPORTED,
                   "exposure_us %u: this camera takes %lld to %lld; choose between them", config.exposure_us,
                   static_cast<long long>(range.min), static_cast<long long>(range.max));
  const sphc_status status = plugin.set(device, "ExposureTime", config.exposure_us);
  if (status == SPHC_OK) return SPHC_OK;
  return explain(message, status, "exposure_us %u: this camera refuses it; use 0", config.exposure_us);
}

sphc_status chooseRate(const sphc_libcamera_plugin &plugin, sphc_libcamera_device *device,
                       const sphc_libcamera_config &config, sphc_message *message) {
  if (config.rate_hz == 0) return SPHC_OK;
  const int64_t period_us = (1000000 + config.rate_hz / 2) / config.rate_hz;
  sphc_libcamera_range range;
  if (plugin.control(device, "FrameDurationLimits", &range) != SPHC_OK)
    return explain(message, SPHC_E_UNSUPPORTED, "rate_hz %u: this camera's rate cannot be set; use 0",
                   config.rate_hz);
  if (period_us < range.min || period_us > range.max)
    return explain(message, SPHC_E_UNSUPPORTED,
                   "rate_hz %u: a frame of this camera takes %lld to %lld us; choose a rate between",
                   config.rate_hz, static_cast<long long>(range.min), static_cast<long long>(range.max));
  const sphc_status status = plugin.set(device, "FrameDurationLimits", period_us);
  if (status == SPHC_OK) return SPHC_OK;
  return explain(message, status, "rate_hz %u: this camera refuses it; use 0", config.rate_hz);
}

}  // namespace

sphc_status setUp(const sphc_libcamera_plugin &plugin, sphc_libcamera_device *device,
                  const sphc_libcamera_config &config, Setup *setup, sphc_message *message) {
  sphc_status status = chooseMode(plugin, device, config, setup, message);
  if (status == SPHC_OK) status = chooseExposure(plugin, device, config, setup, message);
  if (status == SPHC_OK) status = chooseRate(plugin, device, config, message);
  return status;
}

}  // namespace sphc::libcamera
