// Matches query descriptors to map points: over the whole map through its index, or, once a pose is roughly known,
// only to points in the direction where the pose expects them.
#pragma once
#include "runtime/base/arena.h"
#include "runtime/map/map_view.h"
#include "runtime/stages/match/distance.h"
#include "runtime/stages/match/sector_cones.h"
#include "runtime/types/match.h"

namespace sphc {

// All calls write to `matches`, which has room for every query: at most one query for each map point, best ratio
// first; they return how many.  `max_ratio` is of Lowe's test, on distances.  One matcher serves any number of
// maps, one after another.
class Matcher {
 public:
  static constexpr uint32_t kMaxProbes = 32;

  // Depends on no map.
  static void layout(uint32_t max_queries, Arena &scratch, Matcher *matcher);

  // Nearest neighbours in the `probes` cells (1 to kMaxProbes) of the map's index nearest to each query;
  // docs/matching.md says what share of the exact matches that finds.
  uint32_t matchAll(const MapView &map, Span<const Descriptor> queries, float max_ratio, uint32_t probes,
                    Span<Match> matches);

  // Nearest neighbours over the whole map: what matchAll approaches.
  uint32_t matchExact(const MapView &map, Span<const Descriptor> queries, float max_ratio, Span<Match> matches);

  // Nearest neighbours among the map points within a cap around each query's expected direction (unit, map frame).
  uint32_t matchNear(const MapView &map, Span<const Descriptor> queries, Span<const Direction> expected,
                     float cap_cosine, float max_ratio, Span<Match> matches);

 private:
  void begin(const MapView &map, size_t queries);
  uint32_t chooseCells(const Descriptor &query, uint32_t probes, Span<Ranked> cells) const;
  void listByCell(const MapView &map, Span<const Descriptor> queries, uint32_t probes);
  void searchNear(const MapView &map, const Descriptor &query, const Cap &cap, NearestTwo *nearest) const;
  uint32_t select(size_t queries, float max_ratio, Span<Match> matches);

  Span<NearestTwo> nearest_;
  Span<uint16_t> probed_;  // cells of each query
  Span<uint32_t> starts_;  // of each cell's queries in `askers_`
  Span<uint32_t> askers_;
  Span<uint32_t> cell_length2_, group_length2_;
  CellTable table_;  // of the map that is being matched
  SectorCones cones_;
};

}  // namespace sphc
