// light.h - light falling on a face: lamps with shadows, the window, and what the surroundings leave open.
#pragma once

#include "drivers/simulated/builder.h"
#include "drivers/simulated/bvh.h"
#include "drivers/simulated/room.h"

namespace sphc::simulated {

// Multiplies the painted texels of one face by the light that falls on it.
void shade(const Bvh &bvh, const RoomPlan &plan, const Shape &shape, int face, const Texture &texture,
           Texel *texels);

}  // namespace sphc::simulated
