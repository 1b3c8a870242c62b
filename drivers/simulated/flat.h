// flat.h - eight rooms in two rows, joined in a ring by doorways.
#pragma once

#include "drivers/simulated/room.h"

namespace sphc::simulated {

// The first solid is the box that all is in; the origin is in the middle of the first room's floor.  `with`: as in
// sphc_simulated_config.
FloorPlan layOutFlat(Builder &builder, uint32_t with);

}  // namespace sphc::simulated
