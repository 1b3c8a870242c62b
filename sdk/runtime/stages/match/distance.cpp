#include "runtime/stages/match/distance.h"

namespace sphc {

uint32_t distance2Scalar(const Descriptor &a, const Descriptor &b) {
  uint32_t sum = 0;
  for (size_t i = 0; i < kDescriptorBytes; ++i) {
    const int32_t difference = a.bytes[i] - b.bytes[i];
    sum += static_cast<uint32_t>(difference * difference);
  }
  return sum;
}

void searchRangeScalar(Span<const Descriptor> map, uint32_t begin, uint32_t end, Span<const Descriptor> queries,
                       Span<NearestTwo> nearest) {
  for (uint32_t i = begin; i < end; ++i)
    for (size_t q = 0; q < queries.size(); ++q) nearest[q].see(distance2Scalar(map[i], queries[q]), i);
}

}  // namespace sphc
