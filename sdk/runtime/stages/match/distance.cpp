#include "runtime/stages/match/distance.h"

namespace sphc {

namespace {

template <typename A, typename B>
uint32_t sumOfSquares(const A *a, const B *b) {
  uint32_t sum = 0;
  for (size_t i = 0; i < kDescriptorBytes; ++i) {
    const int32_t difference = a[i] - b[i];
    sum += static_cast<uint32_t>(difference * difference);
  }
  return sum;
}

}  // namespace

uint32_t distance2Scalar(const Descriptor &a, const Descriptor &b) { return sumOfSquares(a.bytes, b.bytes); }

void searchRangeScalar(Span<const Descriptor> map, uint32_t begin, uint32_t end, Span<const Descriptor> queries,
                       Span<const uint32_t> chosen, Span<NearestTwo> nearest) {
  for (uint32_t i = begin; i < end; ++i)
    for (uint32_t q : chosen) nearest[q].see(distance2Scalar(map[i], queries[q]), i);
}

void searchCandidatesScalar(Span<const Descriptor> map, Span<const uint32_t> candidates, const Descriptor &query,
                            NearestTwo *nearest) {
  for (uint32_t i : candidates) nearest->see(distance2Scalar(map[i], query), i);
}

void widenRowsScalar(Span<const Descriptor> rows, Span<WideRow> wide, Span<uint32_t> length2) {
  const Descriptor zero = {};
  for (size_t i = 0; i < rows.size(); ++i) {
    for (size_t k = 0; k < kDescriptorBytes; ++k) wide[i].lanes[k] = rows[i].bytes[k];
    length2[i] = distance2Scalar(rows[i], zero);
  }
}

void rankCellsScalar(const CellTable &table, const Descriptor &query, Span<Ranked> groups, Span<Ranked> cells) {
  for (uint32_t g = 0; g < table.groups.size(); ++g)
    rank({sumOfSquares(table.groups[g].lanes, query.bytes), g}, groups);
  for (const Ranked &group : groups)
    for (uint32_t c = table.group_begins[group.index]; c < table.group_begins[group.index + 1]; ++c)
      rank({sumOfSquares(table.cells[c].lanes, query.bytes), c}, cells);
}

}  // namespace sphc
