// Matches query descriptors to map points: over the whole map through its index, or, once a pose is roughly known,
// only to points in the direction where the pose expects them.
#pragma once
#include "runtime/base/arena.h"
#include "runtime/base/pace.h"
#include "runtime/base/parallel.h"
#include "runtime/map/map_view.h"
#include "runtime/stages/match/distance.h"
#include "runtime/stages/match/sector_cones.h"
#include "runtime/types/match.h"

namespace sphc {

// ask, then any of the other calls about the same queries: which cells of the map's index are nearest to a query is
// found out once, when it is first needed, and so are the neighbours in the whole map: another ratio costs no other
// search.  They write to `matches`, which has room for every query: at most one
// query for each map point, best ratio first; they return how many.  `max_ratio` is of Lowe's test, on distances.
// Queries are answered in their order.  Those that a deadline leaves unanswered have no match; between two looks at
// the clock lie a bounded number of comparisons, whatever the map is like. One matcher serves any number of maps,
// one after another.
class Matcher {
 public:
  static constexpr uint32_t kMaxProbes = 32;

  // Depends on no map.  Of `parallel` the number of pieces counts.
  static void layout(uint32_t max_queries, Arena &scratch, Matcher *matcher, const Parallel &parallel = {});
  // Once, where layout was told of one.
  void setParallel(const Parallel &parallel) { parallel_ = parallel; }

  // Both are borrowed until the next ask.  `probes`: cells in which matchAll looks for each query, at most
  // kMaxProbes; docs/matching.md says what share of the exact matches that finds.
  void ask(const MapView &map, Span<const Descriptor> queries, uint32_t probes);

  // Nearest neighbours of the first `count` queries in their nearest cells.
  uint32_t matchAll(size_t count, float max_ratio, Span<Match> matches, const Deadline &deadline = {});

  // Nearest neighbours of all queries over the whole map: what matchAll approaches.
  uint32_t matchExact(float max_ratio, Span<Match> matches, const Deadline &deadline = {});

  // Nearest neighbours of the first queries, as many as `expected`, among the map points within a cone around each
  // one's expected direction (unit, map frame).
  uint32_t matchNear(Span<const Direction> expected, float cone_cosine, float max_ratio, Span<Match> matches,
                     const Deadline &deadline = {});

  // Did the deadline leave queries of the last call unanswered?
  bool wasCut() const { return cut_; }
  // Of the first `count` queries, how many should matchAll or matchExact be asked about so as to answer all of
  // these? Those that are answered, where there is no time for the others, as far as earlier calls tell.
  uint32_t answerable(uint32_t count, const Deadline &deadline) const;
  // Is there time to match so many queries near where they are expected?
  bool hasTimeNear(uint32_t count, const Deadline &deadline) const {
    return !(near_pace_.fitting(deadline, count) < count);
  }
  // Cells that so many queries can be looked for in by then, `most` or a half or a quarter of them.
  uint32_t probesWithin(uint32_t count, uint32_t most, const Deadline &deadline) const;

 private:
  static constexpr double kGuessedProbeNs = 900, kGuessedNearNs = 1500;  // before anything was timed
  // Points of a cell, or all, and the queries that are compared with them.
  struct Run {
    IndexRange points;
    Span<const uint32_t> askers;

    uint64_t work() const { return uint64_t{points.end - points.begin} * askers.size(); }
  };
  // Of the comparisons of all runs, in their order.
  struct Share {
    uint64_t first, end;
  };
  // Neighbours in the whole map of the first `count` queries: of those that have none yet.
  void search(size_t count, bool exact, const Deadline &deadline);
  // Of these queries; false where the deadline passed meanwhile, as all below.
  bool searchTogether(Part queries, const Deadline &deadline);
  bool rankUpTo(size_t count, const Deadline &deadline);
  bool rank(size_t query, Watch *watch) const;
  void chooseCells(const Descriptor &query, Span<uint16_t> cells) const;
  Span<const uint16_t> cellsOf(size_t query) const { return {&probed_[query * ranks_], ranks_}; }
  void listByCell(Part queries);
  void listForAll(Part queries);
  uint32_t runCount() const { return exact_ ? 1 : map_->cellCount(); }
  Run run(uint32_t index) const;
  bool searchRuns(const Share &share, Span<NearestTwo> nearest, Watch *watch) const;
  bool searchRun(IndexRange points, Span<const uint32_t> askers, Span<NearestTwo> nearest, Watch *watch) const;
  // Of a piece: in the whole map, the first one's are those of all.
  Span<NearestTwo> nearestOf(uint32_t piece) const {
    return piece == 0 ? nearest_ : Span<NearestTwo>(&partial_[(piece - 1) * nearest_.size()], nearest_.size());
  }
  bool searchNear(size_t query, const SearchCone &cone, Watch *watch, NearestTwo *nearest) const;
  static uint32_t select(Span<const NearestTwo> nearest, float max_ratio, Span<Match> matches);

  // What was asked.
  const MapView *map_ = nullptr;
  Span<const Descriptor> queries_;
  uint32_t probes_ = 0, ranks_ = 0;  // cells that matchAll looks at; that are ranked
  size_t ranked_ = 0;                // queries that are

  Span<NearestTwo> nearest_;  // of the first `found_` queries in the whole map
  Span<NearestTwo> nearby_;   // in the cones
  Span<NearestTwo> partial_;  // in the whole map, of each piece but the first among its points
  size_t found_ = 0;
  bool exact_ = false;  // over all points, not through the index
  bool cut_ = false;
  Pace near_pace_{kGuessedNearNs};
  Pace probes_pace_{kGuessedProbeNs};  // of queries times their probes
  Span<uint16_t> probed_;  // the nearest cells of each query, nearest first; kNoCell where there are fewer
  Span<uint32_t> starts_;  // of each run's queries in `askers_`
  Span<uint32_t> askers_;
  Span<WideRow> wide_cells_, wide_groups_;
  Span<uint32_t> cell_length2_, group_length2_;
  CellTable table_;  // of the map that is being matched
  SectorCones cones_;
  Parallel parallel_;
};

}  // namespace sphc
