// A map in detail: what its bytes are, how its directions lie, what its descriptors are like.
#pragma once
#include <string>
#include <vector>

#include "host/evaluate/map_file.h"

namespace sphc::host {

struct BytePart {
  std::string name;
  uint64_t bytes = 0;
};

struct MapAnatomy {
  std::vector<BytePart> parts;  // together the whole file
  // Directions.
  double nearest_median_deg = 0, nearest_p10_deg = 0;  // angle to the nearest other direction
  double covered_percent = 0;                          // of 800 cells of equal area
  double lopsidedness = 0;                             // length of the mean direction: 0 even, 1 all the same way
  // Descriptors.
  double length_mean = 0, length_sigma = 0;        // L2
  double zero_percent = 0, saturated_percent = 0;  // of all descriptor bytes
  uint32_t doubles = 0;                            // descriptors that occur more than once
};

// `file` has been opened, hence is valid.
MapAnatomy dissect(const MapFile &file, const MapFacts &facts);

}  // namespace sphc::host
