#include "host/audit/attack/map_neighbours.h"

#include <stdexcept>
#include <string>

#include "host/audit/attack/mirror.h"

namespace sphc::host {

MapNeighbours neighboursIn(const Published &map) {
  if (map.directions.size() <= kBeside)
    throw std::runtime_error("the map has " + std::to_string(map.directions.size()) + " points; more than " +
                             std::to_string(kBeside) + " are needed to tell real from fake");
  return {directionNeighbours(map.directions, kBeside), descriptorNeighbours(map.descriptors, kLookalikes),
          nearestDescriptors(mirrorsOf(map.descriptors), map.descriptors, kLookalikes)};
}

}  // namespace sphc::host
