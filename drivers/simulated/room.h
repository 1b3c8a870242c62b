// room.h - lays a room out by its seed.
#pragma once

#include "drivers/simulated/builder.h"

namespace sphc::simulated {

struct Lamp {
  Vec3f position{};
  float strength = 0;
  bool hangs = false;  // from the ceiling; else it stands on the floor
};

struct RoomPlan {
  Vec3d half{};  // of the room; the floor is at z = 0, the ceiling at 2 half.z
  std::vector<Lamp> lamps;
  Vec3f window{}, window_normal{};
  float window_half_m = 0;  // half of its width
};

// `with`: what makes it hard, as in sphc_simulated_config.
RoomPlan layOut(Builder &builder, uint32_t with);

}  // namespace sphc::simulated
