// light.h - light falling on a face: lamps with shadows, the window, and what the surroundings leave open.
#pragma once

#include "drivers/simulated/builder.h"
#include "drivers/simulated/bvh.h"
#include "drivers/simulated/room.h"

namespace sphc::simulated {

// The light of the room, and what it means to the colour camera.  Factors are of the light by default: all lamps
// on, some daylight.
struct Lighting {
  Vec3f lamp_color{1.0f, 0.93f, 0.8f}, sky_color{0.85f, 0.93f, 1.05f};
  float hanging = 1, standing = 1;  // the lamps
  float ambient = 1, sky = 1;
  float sun = 0;         // what falls through the window in a beam
  float outdoors = 1;    // of what a window shows
  float level = 1;       // light on the sensor: the less, the more noise
  float brightness = 1;  // of the image, after the exposure control did what it can
  float exposure_time = 1;
};
// `with`: as in sphc_simulated_config.
Lighting lightingOf(uint32_t with);

// Multiplies the painted texels of one face by the light that falls on it.
void shade(const Bvh &bvh, const FloorPlan &plan, const Lighting &lighting, const Shape &shape, int face,
           const Texture &texture, Texel *texels);
// The same for a face that shines by itself.
void glow(const Lighting &lighting, const Shape &shape, Material material, const Texture &texture, Texel *texels);

}  // namespace sphc::simulated
