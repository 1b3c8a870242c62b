// Drawing some of many places on the sphere so that they keep their distance from each other.
#pragma once
#include <vector>

#include "host/publish/secret_random.h"
#include "runtime/geometry/rotation.h"

namespace sphc::host {

struct Site {
  Vector3 direction;  // unit
  double size;        // what it counts for, in points
};

// Which sites are drawn: about a `share` of all sizes, evenly over the sphere, neighbours (within `reach_rad`)
// rarely together.
std::vector<bool> spreadDraw(const std::vector<Site> &sites, double share, double reach_rad, SecretRandom *random);

}  // namespace sphc::host
