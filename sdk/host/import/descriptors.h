// One descriptor for all that a point was seen with.
#pragma once
#include <vector>

#include "runtime/types/keypoint.h"

namespace sphc::host {

// Index of the one nearest to all others; there is at least one.
size_t medoidOf(const std::vector<const Descriptor *> &descriptors);

}  // namespace sphc::host
