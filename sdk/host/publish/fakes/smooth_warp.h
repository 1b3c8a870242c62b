// A smooth random displacement of directions, which no camera sees from anywhere.
#pragma once
#include <array>

#include "host/publish/secret_random.h"
#include "runtime/geometry/rotation.h"

namespace sphc::host {

// A sum of random waves: near a Gaussian field.  A rotation, a step aside before a plane, and their first
// derivatives do not follow it farther than about `reach_rad`; what lies much nearer together keeps its distances.
class SmoothWarp {
 public:
  // Displaces by `strength_rad`, 1 sigma on each axis across the direction.
  SmoothWarp(double strength_rad, double reach_rad, SecretRandom *random);

  // Unit directions.
  Vector3 operator()(const Vector3 &direction) const;

 private:
  struct Wave {
    Vector3 frequency, amplitude;
    double phase;
  };
  std::array<Wave, 24> waves_;
};

}  // namespace sphc::host
