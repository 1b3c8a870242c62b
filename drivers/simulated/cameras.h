// cameras.h - which cameras the headset carries, by name: headset, phone, wide, glasses.
#pragma once

#include "drivers/simulated/simulated.h"

namespace sphc::simulated {

struct Cameras {
  sphc_rig rig;
  float vignetting;    // how fast light falls off the axis of the colour camera
  bool smooths_depth;  // the device fills holes and smooths edges before it gives depth
};

// `kind` must have passed checkCameras.
Cameras camerasOf(uint32_t kind);

// ARGUMENT: a number that is none, or raw depth of a device that gives none.
sphc_status checkCameras(const sphc_simulated_config &config, sphc_message *message);

}  // namespace sphc::simulated
