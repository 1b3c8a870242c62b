// What may tell a real point from a fake one, in numbers: how dense directions lie about it, whether its neighbours
// in direction look like it, whether those that look like it lie near, whether some look like its mirror image,
// and how it looks.
#pragma once
#include <Eigen/Core>

#include "host/audit/attack/co_occurrence.h"
#include "host/audit/attack/map_neighbours.h"

namespace sphc::host {

constexpr Eigen::Index kRealOrFakeFeatures = 60;

struct RealOrFakeFeatures {
  Eigen::MatrixXf values;  // a row a point, kRealOrFakeFeatures columns
  // Each a cue by itself, larger for points that seem real.
  Eigen::ArrayXf density, lookalikes, mirror, co_occurrence;
};

RealOrFakeFeatures realOrFakeFeatures(const Published &map, const MapNeighbours &neighbours,
                                      const CoOccurrence &co_occurrence);

}  // namespace sphc::host
