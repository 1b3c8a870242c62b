// room.h - lays a room out by its seed.
#pragma once

#include "drivers/simulated/builder.h"

namespace sphc::simulated {

struct RoomPlan {
  Vec3d half{};                 // of the room; the floor is at z = 0, the ceiling at 2 half.z
  std::vector<Vec3f> lamps;     // where light comes from
  std::vector<float> strength;  // of each
  Vec3f window{}, window_normal{};
};

RoomPlan layOut(Builder &builder);

}  // namespace sphc::simulated
