// The sphere, cut into patches of points.
#pragma once
#include <vector>

#include "host/publish/fakes/strategy.h"

namespace sphc::host {

struct Patch {
  uint32_t number;  // among its cloud's
  std::vector<size_t> points;
  Vector3 middle;  // unit
};

// The patches that have points, about `*width_rad` wide, at random.  A cloud that covers little of the sphere needs
// narrower ones: their width is left in `*width_rad`.
std::vector<Patch> cutIntoPatches(const std::vector<SpherePoint> &points, double *width_rad, SecretRandom *random);

// Columns: two axes across `direction`, turned at random, and itself.
Matrix3 frameAt(const Vector3 &direction, SecretRandom *random);
Vector3 normalVector(SecretRandom *random);

}  // namespace sphc::host
