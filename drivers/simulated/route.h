// route.h - the closed line on the floor that a lap of the walk follows.
#pragma once

#include <memory>

#include "drivers/simulated/room.h"

namespace sphc::simulated {

class Route {
 public:
  virtual ~Route() = default;
  // A point of the floor: 2 pi of `angle` are a lap; `reach` 1 is on the line, more is outside of it.
  virtual Vec3d at(double angle, double reach) const = 0;
  // Yaw of what is to the right of somebody who goes along by growing angles: away from the middle of a room.
  virtual double outwards(double angle) const = 0;
  // Nearer to the middle of each room, where its furniture leaves too little space.
  virtual void shrink() = 0;
  // From the camera to the nearest surface: wished for.
  virtual float wantedClearance() const = 0;
  // How often a lap has what a lap of a room has once: glances, nods, steps to the side.  Odd, so that what differs
  // from lap to lap of a room does so here.
  virtual int looks() const = 0;
};

// Around the middle of a room, or through all rooms of a flat, each around its middle on the side that `seed` says.
std::unique_ptr<Route> makeRoute(const FloorPlan &plan, uint64_t seed);

}  // namespace sphc::simulated
