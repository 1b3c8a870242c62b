// What tells the real layer of a stack from the fakes on top of it, point by point: whether what looks like it, as
// it is or in the mirror, goes on in other stacks, and how near.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "host/audit/attack/map_neighbours.h"

namespace sphc::host {

constexpr Eigen::Index kStackFeatures = 48;

// A row a point, kStackFeatures columns.  `stacks` of stacksOf.
Eigen::MatrixXf stackFeatures(const std::vector<Vector3> &directions, const MapNeighbours &neighbours,
                              const std::vector<uint32_t> &stacks);

}  // namespace sphc::host
