// scene.h - the finished room: solids with painted, lit faces.  Immutable once made.
#pragma once

#include <vector>

#include "drivers/simulated/room.h"
#include "drivers/simulated/shape.h"
#include "drivers/simulated/texture.h"

namespace sphc::simulated {

struct Scene {
  std::vector<Shape> shapes;  // the first is the room
  TexturePool pool;
  RoomPlan plan;
};

Scene makeScene(uint64_t seed, uint32_t threads);

// Distance from a point to the nearest surface (of bounding boxes); 0 inside a solid.
float clearance(const Scene &scene, const Vec3f &point);

}  // namespace sphc::simulated
