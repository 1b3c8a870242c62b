#include "drivers.h"
#include "drivers/libcamera/libcamera.h"

namespace sphc::contract {

namespace {

OpenedDriver openLibcamera() {
  sphc_libcamera_config config;
  sphc_libcamera_config_init(&config, sizeof config);
  config.width = 64;
  config.height = 48;
  config.plugin_path = SPHC_FAKE_LIBCAMERA;
  sphc_libcamera *camera = nullptr;
  sphc_libcamera_open(nullptr, &config, &camera, nullptr);
  OpenedDriver opened{{}, {camera, [](sphc_libcamera *closing) { sphc_libcamera_close(&closing); }}};
  sphc_libcamera_source(camera, &opened.source);
  return opened;
}

}  // namespace

std::vector<Driver> libcameraDrivers() { return {{"LibcameraOnAFake", openLibcamera, 0, true, 1}}; }

}  // namespace sphc::contract
