// Pictures whose scores are known.
#pragma once
#include <cstdint>

#include "host/audit/score/truth_view.h"

namespace sphc::host {

// Rectangles of chance greys, some of it unknown; another for every seed.
TruthView truthPicture(uint64_t seed);

}  // namespace sphc::host
