#include <dlfcn.h>

#include "drivers.h"
#include "drivers/libcamera/libcamera.h"
#include "fake_libcamera.h"

namespace sphc::contract {

namespace {

// What the fake plug-in is told holds for all its cameras.
FakeLibcamera *fake() {
  static void *library = dlopen(SPHC_FAKE_LIBCAMERA, RTLD_NOW | RTLD_NODELETE);
  return reinterpret_cast<FakeLibcameraFn>(dlsym(library, kFakeLibcameraSymbol))();
}

OpenedDriver openLibcamera() {
  sphc_libcamera_config config;
  sphc_libcamera_config_init(&config, sizeof config);
  config.width = 64;
  config.height = 48;
  config.plugin_path = SPHC_FAKE_LIBCAMERA;
  sphc_libcamera *camera = nullptr;
  sphc_libcamera_open(nullptr, &config, &camera, nullptr);
  const auto close = [](sphc_libcamera *closing) {
    sphc_libcamera_close(&closing);
    fake()->unplugged = fake()->stalled = false;
  };
  OpenedDriver opened{{}, {camera, close}, [] { fake()->unplugged = true; }, [] { fake()->stalled = true; }};
  sphc_libcamera_source(camera, &opened.source);
  return opened;
}

}  // namespace

std::vector<Driver> libcameraDrivers() { return {{"LibcameraOnAFake", openLibcamera, 0, true, 1, 0, false}}; }

}  // namespace sphc::contract
