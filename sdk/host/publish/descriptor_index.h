// The index of a map: where points of alike descriptors and near directions lie together (docs/map_format.md).
#pragma once
#include <cstdint>
#include <vector>

#include "runtime/map/layout.h"
#include "runtime/types/keypoint.h"

namespace sphc::host {

struct DescriptorIndex {
  std::vector<Descriptor> centroids;        // of the cells
  std::vector<uint32_t> groups;             // first cell of each group, and the number of cells
  std::vector<Descriptor> group_centroids;  //
  uint32_t sector_side = 1;
  std::vector<uint32_t> runs;   // first point of each sector of each cell, and the number of points
  std::vector<uint32_t> order;  // where in the input the map's points come from
};

// Real and fake points are treated alike, and points of one cell and sector keep the order of the input: shuffle it
// first.  The same input gives the same index on every machine.
DescriptorIndex makeIndex(const std::vector<Descriptor> &descriptors,
                          const std::vector<PackedDirection> &directions);

}  // namespace sphc::host
