// A map file as an attacker reads it.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/geometry/rotation.h"
#include "runtime/map/layout.h"
#include "runtime/types/keypoint.h"

namespace sphc::host {

struct Published {
  std::vector<PackedDirection> packed;
  std::vector<Vector3> directions;  // unit; the same as packed
  std::vector<Descriptor> descriptors;
  std::vector<uint32_t> runs;  // first entry of each sector of each cell, and the number of entries
};

// Whatever extractor described it.  Throws std::runtime_error when the bytes are no map.
Published publishedIn(const std::vector<uint8_t> &file);
std::vector<uint8_t> readMapFile(const std::string &path);

}  // namespace sphc::host
