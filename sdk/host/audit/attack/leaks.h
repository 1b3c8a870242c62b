// What a map file might say besides directions and descriptors: by the order of its entries, by low bits, by bytes
// that nobody reads.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "host/audit/attack/published.h"

namespace sphc::host {

// A number for each entry by which real ones might be told from fake ones.
struct Cue {
  std::string name;
  std::vector<double> scores;
};

// Rank within its run of equals, rank in the file, bits of the packed direction, the number of entries that are
// equal.
std::vector<Cue> fileCues(const Published &map);

// By how many standard deviations entries that follow each other within a run are nearer in direction than others
// of it: builders that keep the order in which points were found give themselves away.
double orderZ(const Published &map);

// Bytes of the file that no field of the format accounts for, and that are not zero.
size_t strayBytes(const std::vector<uint8_t> &file);

}  // namespace sphc::host
