// What may tell a real point from a fake one, in numbers: how dense directions lie about it, whether its neighbours
// in direction look like it, whether those that look like it lie near, whether some look like its mirror image,
// and how it looks.
#pragma once
#include <Eigen/Core>

#include "host/audit/attack/co_occurrence.h"
#include "host/audit/attack/neighbours.h"
#include "host/audit/attack/published.h"

namespace sphc::host {

constexpr Eigen::Index kRealOrFakeFeatures = 60;

struct RealOrFakeFeatures {
  Eigen::MatrixXf values;  // a row a point, kRealOrFakeFeatures columns
  Neighbours beside;       // by direction
  // Each a cue by itself, larger for points that seem real.
  Eigen::ArrayXf density, lookalikes, other_stacks, mirror, co_occurrence;
};

// Throws std::runtime_error when the map has too few points to have neighbours.
RealOrFakeFeatures realOrFakeFeatures(const Published &map, const CoOccurrence &co_occurrence);

}  // namespace sphc::host
