// Normal noise for cases that are made from others.
#pragma once
#include <cmath>

#include "runtime/base/random.h"
#include "runtime/geometry/rotation.h"

namespace sphc::host {

// Standard normal (Box and Muller).
inline double normalOf(Random *random) {
  const double radius = std::sqrt(-2 * std::log(1 - random->uniform()));
  return radius * std::cos(2 * kPi * random->uniform());
}
inline Vector3 normalVector(Random *random) {
  const double x = normalOf(random), y = normalOf(random), z = normalOf(random);
  return {x, y, z};
}

}  // namespace sphc::host
