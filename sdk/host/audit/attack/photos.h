// Whoever has photos of the place, or of a thing in it, knows which entries show it: those that match are real, and
// those that match in the mirror are fakes that show it too.
#pragma once
#include <vector>

#include "host/audit/attack/descriptor_pairs.h"
#include "host/audit/attack/published.h"
#include "host/audit/attack/querying_client.h"

namespace sphc::host {

enum class Photo { kAsItIs, kMirrored };

// Pairs of a photo's point and an entry, by the ratio test, that have company: two more pairs that lie beside them
// in the photo and in the map.  Beside in the photo is what is within 0.3 m.
std::vector<EntryPair> matchesInCompany(const Published &map, const std::vector<OwnPoint> &photo, Photo how);

// Their entries, each once, ascending.
std::vector<uint32_t> markedBy(const Published &map, const std::vector<std::vector<OwnPoint>> &photos, Photo how);

}  // namespace sphc::host
