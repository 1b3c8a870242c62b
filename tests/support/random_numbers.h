// Random vectors, rotations and descriptors for tests; the same on every machine.
#pragma once
#include <cstdint>

#include "runtime/base/elementary.h"
#include "runtime/base/random.h"
#include "runtime/geometry/rigid.h"
#include "runtime/types/keypoint.h"

namespace sphc::test {

inline double uniformIn(Random *random, double low, double high) { return low + (high - low) * random->uniform(); }

inline double normal(Random *random) {  // Box and Muller 1958
  const double radius = sqrtOf(-2 * logOf(1 - random->uniform()));
  double sine, cosine;
  sinCos(2 * kPi * random->uniform(), &sine, &cosine);
  return radius * cosine;
}

inline Vector3 normalVector(Random *random) {
  const double x = normal(random), y = normal(random), z = normal(random);
  return {x, y, z};
}

inline Vector3 randomDirection(Random *random) { return normalVector(random).normalized(); }

inline Matrix3 randomRotation(Random *random) {
  double q[4];
  for (double &part : q) part = normal(random);
  return rotationFromQuaternion(q);
}

inline Descriptor randomDescriptor(Random *random) {
  Descriptor descriptor;
  for (uint8_t &byte : descriptor.bytes) byte = static_cast<uint8_t>(random->below(256));
  return descriptor;
}

}  // namespace sphc::test
