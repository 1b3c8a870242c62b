#include "host/publish/fakes/smooth_warp.h"

#include <cmath>

#include "host/publish/fakes/patches.h"
#include "runtime/base/elementary.h"

namespace sphc::host {
SmoothWarp::SmoothWarp(double strength_rad, double reach_rad, SecretRandom *random) {
  const double amplitude = strength_rad * std::sqrt(2.0 / static_cast<double>(waves_.size()));
  for (Wave &wave : waves_) {
    wave.frequency = normalVector(random) / reach_rad;
    wave.amplitude = amplitude * normalVector(random);
    wave.phase = 2 * kPi * random->uniform();
  }
}

Vector3 SmoothWarp::operator()(const Vector3 &direction) const {
  Vector3 sum = direction;
  for (const Wave &wave : waves_) sum += std::cos(wave.frequency.dot(direction) + wave.phase) * wave.amplitude;
  return sum.normalized();
}

}  // namespace sphc::host
