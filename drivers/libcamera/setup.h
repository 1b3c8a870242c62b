// What a camera is asked for before it starts: a stream that is exactly the one wanted, its exposure and its rate.
#pragma once

#include "pixel_format.h"
#include "plugin.h"

namespace sphc::libcamera {

struct Setup {
  const PixelFormat *format;
  sphc_libcamera_mode mode;
  sphc_libcamera_range exposure_us;  // both 0: cannot be set
};

// E_ARGUMENT (config), E_UNSUPPORTED with what the camera would do instead, E_DEVICE.
sphc_status setUp(const sphc_libcamera_plugin &plugin, sphc_libcamera_device *device,
                  const sphc_libcamera_config &config, Setup *setup, sphc_message *message);

}  // namespace sphc::libcamera
