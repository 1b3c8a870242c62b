// A pair of captures as the frame that it is.
#pragma once
#include <spherecloud/spherecloud.h>

#include "host/live/rig.h"

namespace sphc::host {

// Borrows the images.
sphc_localizer_frame frameOf(const CapturePair &pair);

}  // namespace sphc::host
