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

// One of the nearest rows of a table.
struct Ranked {
  uint32_t distance2, index;
};

// Puts a row into a list of the nearest, nearest first; of equals the one seen first stays in front.
inline void rank(Ranked row, Span<Ranked> best) {
  size_t at = best.size();
  if (row.distance2 >= best[at - 1].distance2) return;
  for (--at; at > 0 && row.distance2 < best[at - 1].distance2; --at) best[at] = best[at - 1];
  best[at] = row;
}

uint32_t distance2(const Descriptor &a, const Descriptor &b);

// Shows `nearest[q]` the map descriptors [begin, end), in their order, for every q in `chosen`.
void searchRange(Span<const Descriptor> map, uint32_t begin, uint32_t end, Span<const Descriptor> queries,
                 Span<const uint32_t> chosen, Span<NearestTwo> nearest);

// Shows `nearest` the map descriptors in `candidates`, in their order.
void searchCandidates(Span<const Descriptor> map, Span<const uint32_t> candidates, const Descriptor &query,
                      NearestTwo *nearest);

// A descriptor as it is multiplied: every query of a frame passes over many centroids, so these are widened once.
struct WideRow {
  int16_t lanes[kDescriptorBytes];
};

// The cells of a map's index and the groups they are in; squared lengths of their centroids are kept beside them.
struct CellTable {
  Span<const WideRow> groups, cells;
  Span<const uint32_t> group_begins;  // first cell of each group, and the number of cells
  Span<const uint32_t> group_length2, cell_length2;
};

// Rows and their squared lengths.
void widenRows(Span<const Descriptor> rows, Span<WideRow> wide, Span<uint32_t> length2);

// Ranks into `cells` the cells nearest to `query` among those of the nearest groups, into `groups`; both begin with
// rows infinitely far.
void rankCells(const CellTable &table, const Descriptor &query, Span<Ranked> groups, Span<Ranked> cells);

// The scalar version, for tests and for machines without SIMD.
uint32_t distance2Scalar(const Descriptor &a, const Descriptor &b);
void searchRangeScalar(Span<const Descriptor> map, uint32_t begin, uint32_t end, Span<const Descriptor> queries,
                       Span<const uint32_t> chosen, Span<NearestTwo> nearest);
void searchCandidatesScalar(Span<const Descriptor> map, Span<const uint32_t> candidates, const Descriptor &query,
                            NearestTwo *nearest);
void widenRowsScalar(Span<const Descriptor> rows, Span<WideRow> wide, Span<uint32_t> length2);
void rankCellsScalar(const CellTable &table, const Descriptor &query, Span<Ranked> groups, Span<Ranked> cells);

}  // namespace sphc
