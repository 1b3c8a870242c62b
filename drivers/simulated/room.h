// room.h - lays a room out by its seed.
#pragma once

#include "drivers/simulated/builder.h"

namespace sphc::simulated {

struct Lamp {
  Vec3f position{};
  float strength = 0;
  bool hangs = false;  // from the ceiling; else it stands on the floor
};

// A gap in a wall, on the floor, and a unit vector from there into the room.
struct Doorway {
  Vec3d middle{}, inwards{};
};

struct RoomPlan {
  Vec3d center{}, half{};  // of its floor; the floor is at z = 0, the ceiling at 2 half.z
  std::vector<Lamp> lamps;
  Vec3f window{}, window_normal{};
  float window_half_m = 0;  // half of its width
  Doorway in, out;          // of a flat: where the walk comes from, and where it goes on
};

// Rooms in the order of the walk.
struct FloorPlan {
  std::vector<RoomPlan> rooms;

  // Whose light falls on a point: the one it is in, or the nearest.
  const RoomPlan &roomAt(const Vec3f &point) const;
};

// What is given of a room of a flat.  Walls: 0 towards -y, 1 towards +x, 2 towards +y, 3 towards -x.
struct RoomSite {
  struct Gap {
    int wall;
    double world;  // x or y of its middle, whichever is along the wall
  };
  Vec3d center{}, half{};
  int window_wall = 0;
  Gap in{}, out{};
  uint64_t doubles_seed = 0;  // of pieces that are equal; 0: none are
};

// Other than 0 where `with` says that pieces are equal.
uint64_t drawDoublesSeed(Rng &rng, uint32_t with);

// `with`: what makes it hard, as in sphc_simulated_config.
RoomPlan layOutRoom(Builder &builder, uint32_t with);
RoomPlan layOutRoomOfFlat(Builder &builder, const RoomSite &site, uint32_t with);

}  // namespace sphc::simulated
