// A publishable sphere cloud, and the step from private points to directions: the paper's algorithm 1 (supplement,
// section 1.3).  release.h makes clouds.
#pragma once
#include <vector>

#include "host/import/point_model.h"
#include "host/publish/fakes/strategy.h"

namespace sphc::host {

struct SphereCloud {
  std::vector<SpherePoint> points;  // real and fake, shuffled
  sphc_band band = SPHC_BAND_VISIBLE;
};

// Where a new map of these points has its centre: their mean.
Vector3 centreOf(const std::vector<ModelPoint> &points);
SpherePoint seenFrom(const Vector3 &centre_m, const ModelPoint &point);

}  // namespace sphc::host
