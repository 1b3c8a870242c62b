// Entries of two maps that an attacker takes for the same point, by their descriptors.
#pragma once
#include <cstdint>
#include <vector>

#include "runtime/types/keypoint.h"

namespace sphc::host {

struct EntryPair {
  uint32_t a, b;
};

// Equal bytes first; of the others the nearest, where it is nearer than `ratio` times the second.
std::vector<EntryPair> pairEntries(const std::vector<Descriptor> &a, const std::vector<Descriptor> &b,
                                   double ratio);

}  // namespace sphc::host
