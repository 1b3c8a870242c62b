// Is this object in the map?  A stranger's picture of it, by its descriptors alone.
#pragma once
#include <vector>

#include "host/audit/attack/published.h"

namespace sphc::host {

// Share of the crop's descriptors that find one entry much nearer than the second; 0 for a crop without any.
double presenceScore(const Published &map, const std::vector<Descriptor> &crop, double ratio = 0.8);

// The same, and the crop's mirror image beside it: where fakes carry mirrored descriptors, what was removed is
// found there.  Twice 1 at most.
double presenceScoreMirroredToo(const Published &map, const std::vector<Descriptor> &crop, double ratio = 0.8);

}  // namespace sphc::host
