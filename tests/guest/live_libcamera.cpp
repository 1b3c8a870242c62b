#include <stdexcept>

#include "drivers/libcamera/libcamera.h"
#include "live_drivers.h"
#include "recorded.h"

namespace sphc::guest {

LiveSource openLibcamera(const std::string &id) {
  sphc_libcamera_config config;
  sphc_libcamera_config_init(&config, sizeof config);
  config.width = kColorWidth;
  config.height = kColorHeight;
  sphc_message message = {};
  sphc_libcamera *camera = nullptr;
  if (sphc_libcamera_open(id.empty() ? nullptr : id.c_str(), &config, &camera, &message) != SPHC_OK)
    throw std::runtime_error(message.text);
  LiveSource live{{}, {camera, [](sphc_libcamera *closing) { sphc_libcamera_close(&closing); }}};
  sphc_libcamera_source(camera, &live.source);
  return live;
}

}  // namespace sphc::guest
