// The neighbours of every point of a map, which all that tell real from fake begin with; computed once.
#pragma once
#include "host/audit/attack/neighbours.h"
#include "host/audit/attack/published.h"

namespace sphc::host {

struct MapNeighbours {
  Neighbours beside;    // by direction
  Neighbours alike;     // by descriptor
  Neighbours mirrored;  // those that look like the mirror image of each
};

constexpr int kBeside = 48, kLookalikes = 24;

// Throws std::runtime_error when the map has too few points to have neighbours.
MapNeighbours neighboursIn(const Published &map);

}  // namespace sphc::host
