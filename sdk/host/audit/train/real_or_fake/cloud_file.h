// A cloud with its truth, as the tools here hand it to each other.  Little-endian: uint32 count, then of all points
// float32 x, y, z of the unit direction, 128 bytes of the descriptor, a byte that is 1 for real and 0 for fake.
#pragma once
#include <string>
#include <vector>

#include "host/audit/attack/published.h"

namespace sphc::host {

struct KnownCloud {
  Published published;
  std::vector<bool> real;
};

// Both throw std::runtime_error.
void writeCloud(const std::string &path, const KnownCloud &cloud);
KnownCloud readCloud(const std::string &path);

}  // namespace sphc::host
