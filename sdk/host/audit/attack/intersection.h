// Several releases about one centre: where descriptor and direction agree twice, the direction was no accident.
#pragma once
#include <vector>

#include "host/audit/attack/published.h"

namespace sphc::host {

struct IntersectionOptions {
  double angle_rad = 5e-4;  // two packed directions of one are as near; a point that was measured anew is not
  double ratio = 0.8;       // of descriptors that are not equal
};

// Entries of each release that another one confirms.
std::vector<std::vector<uint32_t>> intersectReleases(const std::vector<Published> &releases,
                                                     const IntersectionOptions &options);

}  // namespace sphc::host
