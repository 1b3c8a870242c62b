// The nearest others of every point: by direction, and by descriptor.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "runtime/geometry/rotation.h"
#include "runtime/types/keypoint.h"

namespace sphc::host {

// A row a point, nearest first, itself not among them.
struct Neighbours {
  Eigen::ArrayXXi indices;
  Eigen::ArrayXXf distances;
};

// There must be more than `count` points.
Neighbours directionNeighbours(const std::vector<Vector3> &directions, int count);       // chords
Neighbours descriptorNeighbours(const std::vector<Descriptor> &descriptors, int count);  // L2 of bytes

// A row a query: the nearest of `table`, which has `count` or more; L2 of bytes.
Neighbours nearestDescriptors(const std::vector<Descriptor> &queries, const std::vector<Descriptor> &table,
                              int count);

}  // namespace sphc::host
