// Exact matching by the ratio test (Lowe 2004), the same for all systems that are compared.
#pragma once
#include <cstdint>
#include <vector>

#include "runtime/types/keypoint.h"

namespace sphc::host {

struct RatioMatch {
  uint32_t query = 0, point = 0;
  uint32_t squared_distance = 0;
};

// A match for each query whose nearest point is nearer than `ratio` times the second; of queries with one point the
// nearest stays.
std::vector<RatioMatch> matchByRatio(const std::vector<Descriptor> &queries, const std::vector<Descriptor> &points,
                                     double ratio);

}  // namespace sphc::host
