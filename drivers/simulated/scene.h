// scene.h - the finished room: solids with painted, lit faces.  Nothing of it changes once it is made; a face is
// painted when it is first seen.
#pragma once

#include <vector>

#include "drivers/simulated/actors.h"
#include "drivers/simulated/light.h"
#include "drivers/simulated/room.h"
#include "drivers/simulated/shape.h"
#include "drivers/simulated/simulated.h"
#include "drivers/simulated/texture.h"

namespace sphc::simulated {

// A face behind which a ray goes on: a mirror's, into the room again; a window's, into the street.
struct Portal {
  uint32_t shape;
  bool mirrors;
};

struct Scene {
  std::vector<Shape> shapes;  // the first is the room, or the box that a flat is in; the last are the actors'
  uint32_t fixed_count = 0;   // those before the actors'
  Actors actors;
  std::vector<Shape> outdoors;  // empty, or a room around the room, and no more
  std::vector<Portal> portals;
  TexturePool pool;
  FloorPlan plan;
  Lighting lighting;
};

// Everything there is but for its paint, and in `jobs` what is to be painted.
Scene buildScene(const sphc_simulated_config &config, std::vector<Job> &jobs);
Scene makeScene(const sphc_simulated_config &config);

// Distance from a point to the nearest surface (of bounding boxes) of what never moves; 0 inside a solid.
float clearance(const Scene &scene, const Vec3f &point);

}  // namespace sphc::simulated
