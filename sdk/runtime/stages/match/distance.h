// Squared L2 distances of byte descriptors: integers, so every width of SIMD gives the same answer.
#pragma once
#include <cstdint>

#include "runtime/base/span.h"
#include "runtime/types/keypoint.h"

namespace sphc {

// The two nearest of the descriptors seen so far.
struct NearestTwo {
  uint32_t best2, second2;
  uint32_t best_index;

  void see(uint32_t distance2, uint32_t index) {
    if (distance2 < best2) {
      second2 = best2;
      best2 = distance2;
      best_index = index;
    } else if (distance2 < second2) {
      second2 = distance2;
    }
  }
};

uint32_t distance2(const Descriptor &a, const Descriptor &b);
// Shows `nearest[q]` the map descriptors [begin, end) for every query q.
void searchRange(Span<const Descriptor> map, uint32_t begin, uint32_t end, Span<const Descriptor> queries,
                 Span<NearestTwo> nearest);

// The scalar twins, for tests and for machines without SIMD.
uint32_t distance2Scalar(const Descriptor &a, const Descriptor &b);
void searchRangeScalar(Span<const Descriptor> map, uint32_t begin, uint32_t end, Span<const Descriptor> queries,
                       Span<NearestTwo> nearest);

}  // namespace sphc
