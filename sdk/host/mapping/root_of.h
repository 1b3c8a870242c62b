// Sets that are joined: each member names another one of its set as its parent, and the root itself.
#pragma once
#include <cstdint>
#include <vector>

namespace sphc::host {

// Halves the way there for the next time (Tarjan and van Leeuwen 1984).
inline uint32_t rootOf(std::vector<uint32_t> *parent, uint32_t i) {
  while ((*parent)[i] != i) i = (*parent)[i] = (*parent)[(*parent)[i]];
  return i;
}

}  // namespace sphc::host
