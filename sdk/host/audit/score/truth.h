// What the owner's ledger says about the entries of a map.
#pragma once
#include <vector>

#include "host/audit/attack/published.h"
#include "host/publish/place.h"

namespace sphc::host {

struct EntryTruth {
  bool real;
  Vector3 position_m;  // of the point that has the descriptor; from the centre
  uint32_t release;    // that published it first
};

// An entry a published one.  Throws std::runtime_error when the map is not of this place.
std::vector<EntryTruth> truthOf(const Published &map, const Place &place);

}  // namespace sphc::host
