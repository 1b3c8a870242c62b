// How alike descriptors are.
#pragma once
#include <vector>

#include "runtime/types/keypoint.h"

namespace sphc::host {

double descriptorDistance(const Descriptor &a, const Descriptor &b);  // L2 of bytes
// Index of the one nearest to all others; there is at least one.
size_t medoidOf(const std::vector<const Descriptor *> &descriptors);

}  // namespace sphc::host
