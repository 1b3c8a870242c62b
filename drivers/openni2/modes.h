// Choosing among the video modes that a device offers.
#pragma once

#include <OniCAPI.h>

#include "openni2.h"

namespace sphc::openni2 {

// Whether a mode has what is wanted, in a format that this driver passes on.
bool modeFits(const OniVideoMode &mode, int stream, const sphc_openni2_mode &wanted);

// Of those that fit: `present` if it is offered, else the first of the format that comes first in openni2.h; null:
// none.
const OniVideoMode *chooseMode(const OniSensorInfo &offered, int stream, const sphc_openni2_mode &wanted,
                               const OniVideoMode &present);

// "640x480@30 RGB888, 320x240@60 ..." for messages, as many as there is room for.
struct ModeList {
  ModeList(const OniVideoMode *modes, int count);
  char text[128];
};

}  // namespace sphc::openni2
