#include "runtime/stages/match/matcher.h"

#include <algorithm>
#include <numeric>

namespace sphc {
namespace {

constexpr uint32_t kTile = 128;  // map descriptors that stay in the nearest cache while all queries pass over them
constexpr uint32_t kGuidedProbes = 8;  // as good as more, since the cone has left out most that mislead
constexpr uint32_t kGathered = 64, kCandidates = 1024;  // runs, and points in them, before they are compared
// Under a deadline: comparisons between two looks at the clock; how many of them the ranking of a query's cells, or
// the search for its sectors, is worth; queries that are answered together.
constexpr uint32_t kGrain = 4096, kRanking = 128, kTogether = 16, kTogetherExact = 16;

constexpr size_t kBlock = 16;          // queries that one piece of those near an expected pose has in sequence
constexpr uint32_t kFewestProbes = 4;  // in time: fewer find too little

constexpr uint32_t kNobody = UINT32_MAX;
constexpr uint16_t kNoCell = UINT16_MAX;
// Two unrelated descriptors are seldom nearer than this; a lone candidate has to beat it by the ratio.
constexpr uint32_t kUnrelated2 = 300 * 300;
constexpr NearestTwo kStart = {kUnrelated2, kUnrelated2, kNobody};
constexpr Ranked kFar = {UINT32_MAX, kNobody};

bool passesRatio(const NearestTwo &nearest, float max_ratio) {
  if (nearest.best_index == kNobody) return false;
  return static_cast<double>(nearest.best2) <
         static_cast<double>(max_ratio) * static_cast<double>(max_ratio) * static_cast<double>(nearest.second2);
}

// The two nearest of what `nearest` has seen, and `later` after it.
void join(const NearestTwo &later, NearestTwo *nearest) {
  nearest->see(later.best2, later.best_index);
  nearest->second2 = std::min(nearest->second2, later.second2);
}

// Of the groups of cells, those whose cells are looked at.
uint32_t groupsVisited(uint32_t groups, uint32_t probes) { return std::min(groups, groups / 4 + probes / 4 + 2); }

}  // namespace

void Matcher::layout(uint32_t max_queries, Arena &scratch, Matcher *matcher, const Parallel &parallel) {
  Matcher discarded;  // receives empty spans while measuring
  Matcher &m = matcher ? *matcher : discarded;
  m.nearest_ = scratch.take<NearestTwo>("match.nearest", max_queries);
  m.nearby_ = scratch.take<NearestTwo>("match.nearest", max_queries);
  m.partial_ = scratch.take<NearestTwo>("match.nearest", size_t{parallel.pieces - 1} * max_queries);
  m.probed_ = scratch.take<uint16_t>("match.probed", size_t{max_queries} * kMaxProbes);
  m.starts_ = scratch.take<uint32_t>("match.askers", kMapMaxCells + 1);
  m.askers_ = scratch.take<uint32_t>("match.askers", size_t{max_queries} * kMaxProbes);
  m.wide_cells_ = scratch.take<WideRow>("match.centroids", kMapMaxCells);
  m.wide_groups_ = scratch.take<WideRow>("match.centroids", kMapMaxGroups);
  m.cell_length2_ = scratch.take<uint32_t>("match.lengths", kMapMaxCells);
  m.group_length2_ = scratch.take<uint32_t>("match.lengths", kMapMaxGroups);
  SectorCones::layout(scratch, matcher ? &m.cones_ : nullptr);
}

void Matcher::ask(const MapView &map, Span<const Descriptor> queries, uint32_t probes) {
  map_ = &map;
  queries_ = queries;
  probes_ = std::min(std::max(probes, uint32_t{1}), std::min(kMaxProbes, map.cellCount()));
  ranks_ = std::max(probes_, std::min(kGuidedProbes, map.cellCount()));
  ranked_ = found_ = 0;
  widenRows(map.centroids(), wide_cells_, cell_length2_);
  widenRows(map.groupCentroids(), wide_groups_, group_length2_);
  table_ = {wide_groups_.first(map.groupCount()), wide_cells_.first(map.cellCount()), map.groupBegins(),
            group_length2_, cell_length2_};
}

// The cells nearest to a query, nearest first, by way of the groups that they are in.
void Matcher::chooseCells(const Descriptor &query, Span<uint16_t> cells) const {
  Ranked near_groups[kMapMaxGroups], near_cells[kMaxProbes];
  const uint32_t wanted = static_cast<uint32_t>(cells.size());
  const Span<Ranked> groups(near_groups, groupsVisited(static_cast<uint32_t>(table_.groups.size()), wanted)),
      ranked(near_cells, wanted);
  std::fill(groups.begin(), groups.end(), kFar);
  std::fill(ranked.begin(), ranked.end(), kFar);
  rankCells(table_, query, groups, ranked);
  for (uint32_t k = 0; k < wanted; ++k)
    cells[k] = ranked[k].index == kNobody ? kNoCell : static_cast<uint16_t>(ranked[k].index);
}

bool Matcher::rank(size_t query, Watch *watch) const {
  if (watch->passed(kRanking)) return false;
  chooseCells(queries_[query], {&probed_[query * ranks_], ranks_});
  return true;
}

bool Matcher::rankUpTo(size_t count, const Deadline &deadline) {
  if (ranked_ >= count) return true;
  const uint32_t pieces = parallel_.pieces;
  const bool in_time = parallel_.allOf(pieces, [&](uint32_t i) {
    const Part part = partOf(count - ranked_, pieces, i);
    Watch watch(deadline, kGrain);
    for (size_t q = part.first; q < part.end; ++q)
      if (!rank(ranked_ + q, &watch)) return false;
    return true;
  });
  if (in_time) ranked_ = count;
  return in_time;
}

// Turns "cells of a query" into "queries of a cell", in the order of the queries.
void Matcher::listByCell(Part queries) {
  const Span<uint32_t> starts = starts_.first(map_->cellCount() + 1);
  std::fill(starts.begin(), starts.end(), 0u);
  for (size_t q = queries.first; q < queries.end; ++q)
    for (const uint16_t cell : cellsOf(q).first(probes_))
      if (cell != kNoCell) ++starts[cell];
  uint32_t sum = 0;
  for (uint32_t &start : starts) {
    sum += start;
    start = sum;
  }
  for (size_t q = queries.end; q > queries.first; --q)  // backwards, so that the starts end where they should
    for (const uint16_t cell : cellsOf(q - 1).first(probes_))
      if (cell != kNoCell) askers_[--starts[cell]] = static_cast<uint32_t>(q - 1);
}

uint32_t Matcher::matchAll(size_t count, float max_ratio, Span<Match> matches, const Deadline &deadline) {
  search(count, false, deadline);
  return select(nearest_.first(std::min(found_, count)), max_ratio, matches);
}

uint32_t Matcher::matchExact(float max_ratio, Span<Match> matches, const Deadline &deadline) {
  search(queries_.size(), true, deadline);
  return select(nearest_.first(found_), max_ratio, matches);
}

uint32_t Matcher::matchNear(Span<const Direction> expected, float cone_cosine, float max_ratio, Span<Match> matches,
                            const Deadline &deadline) {
  const int64_t begin_ns = deadline.clock.now();
  cones_.prepare(map_->sectorSide(), cone_cosine);
  std::fill_n(nearby_.begin(), expected.size(), kStart);
  const uint32_t pieces = parallel_.pieces;
  size_t ends[Parallel::kMostPieces];  // of each piece the first query that it left
  std::fill_n(ends, pieces, expected.size());
  parallel_.forEach(pieces, [&](uint32_t i) {
    Watch watch(deadline, kGrain);
    // The first ones may be ranked, so that a query is no measure of work: pieces take turns.
    for (size_t block = i; block * kBlock < expected.size(); block += pieces) {
      const size_t end = std::min(expected.size(), (block + 1) * kBlock);
      for (size_t q = block * kBlock; q < end; ++q) {
        NearestTwo nearest = kStart;
        const bool is_answered =
            (q < ranked_ || rank(q, &watch)) && searchNear(q, {expected[q], cone_cosine}, &watch, &nearest);
        if (!is_answered) {
          ends[i] = q;
          return;
        }
        nearby_[q] = nearest;
      }
    }
  });
  const size_t all = *std::min_element(ends, ends + pieces);  // the first ones, which are answered
  cut_ = all < expected.size();
  ranked_ = std::max(ranked_, all);
  if (deadline.isSet()) near_pace_.learn(static_cast<double>(all), elapsedNs(begin_ns, deadline.clock.now()));
  return select(nearby_.first(expected.size()), max_ratio, matches);
}

// A query is answered in full or not at all: the nearest point that was seen so far is none to be matched.
void Matcher::search(size_t count, bool exact, const Deadline &deadline) {
  if (exact_ != exact) found_ = 0;
  exact_ = exact;
  const size_t begin = found_;
  const int64_t begin_ns = deadline.clock.now();
  const size_t together =
      !deadline.isSet() ? count : size_t{parallel_.pieces} * (exact ? kTogetherExact : kTogether);
  while (found_ < count) {
    const Part queries = {found_, std::min(count, found_ + together)};
    if (!searchTogether(queries, deadline)) break;
    found_ = queries.end;
  }
  cut_ = found_ < count;
  if (!deadline.isSet()) return;
  const double probed = static_cast<double>(found_ - begin) * probes_;
  probes_pace_.learn(probed, elapsedNs(begin_ns, deadline.clock.now()));
}

uint32_t Matcher::probesWithin(uint32_t count, uint32_t most, const Deadline &deadline) const {
  const double all = static_cast<double>(count) * most, fitting = probes_pace_.fitting(deadline, all);
  uint32_t probes = most;
  while (probes > kFewestProbes && static_cast<double>(count) * probes > fitting) probes /= 2;
  return probes;
}

uint32_t Matcher::answerable(uint32_t count, const Deadline &deadline) const {
  if (count <= found_) return count;
  const double rest = count - static_cast<double>(found_);
  return probes_pace_.fitting(deadline, rest * probes_) < rest * probes_ ? static_cast<uint32_t>(found_) : count;
}

// In pieces of the map, so that each point is read once; of about as many comparisons each.
bool Matcher::searchTogether(Part queries, const Deadline &deadline) {
  if (!exact_ && !rankUpTo(queries.end, deadline)) return false;
  if (exact_)
    listForAll(queries);
  else
    listByCell(queries);
  uint64_t work = 0;
  for (uint32_t r = 0; r < runCount(); ++r) work += run(r).work();
  const uint32_t pieces = parallel_.pieces;
  const bool in_time = parallel_.allOf(pieces, [&](uint32_t i) {
    const Span<NearestTwo> nearest = nearestOf(i);
    std::fill(nearest.begin() + queries.first, nearest.begin() + queries.end, kStart);
    Watch watch(deadline, kGrain);
    return searchRuns({work * i / pieces, work * (i + 1) / pieces}, nearest, &watch);
  });
  for (uint32_t i = 1; i < pieces; ++i)
    for (size_t q = queries.first; q < queries.end; ++q) join(nearestOf(i)[q], &nearest_[q]);
  return in_time;
}

void Matcher::listForAll(Part queries) {
  starts_[0] = 0;
  starts_[1] = static_cast<uint32_t>(queries.size());
  std::iota(askers_.begin(), askers_.begin() + queries.size(), static_cast<uint32_t>(queries.first));
}

Matcher::Run Matcher::run(uint32_t index) const {
  const Span<const uint32_t> askers(askers_.data() + starts_[index], starts_[index + 1] - starts_[index]);
  return {exact_ ? IndexRange{0, map_->pointCount()} : map_->cell(index), askers};
}

bool Matcher::searchRuns(const Share &share, Span<NearestTwo> nearest, Watch *watch) const {
  uint64_t done = 0;
  for (uint32_t r = 0; r < runCount() && done < share.end; ++r) {
    const Run own = run(r);
    const uint64_t before = done, askers = own.askers.size();
    done += own.work();
    if (done <= share.first || askers == 0) continue;
    // A point belongs to the piece that its first comparison lies in.
    const auto pointAt = [&](uint64_t at) {
      return at <= before ? own.points.begin
             : at >= done ? own.points.end
                          : own.points.begin + static_cast<uint32_t>((at - before + askers - 1) / askers);
    };
    if (!searchRun({pointAt(share.first), pointAt(share.end)}, own.askers, nearest, watch)) return false;
  }
  return true;
}

bool Matcher::searchRun(IndexRange points, Span<const uint32_t> askers, Span<NearestTwo> nearest,
                        Watch *watch) const {
  const auto count = static_cast<uint32_t>(askers.size());
  for (uint32_t at = points.begin; at < points.end; at += kTile) {
    const uint32_t end = std::min(at + kTile, points.end);
    if (watch->passed(count * (end - at))) return false;
    searchRange(map_->descriptors(), at, end, queries_, askers, nearest);
  }
  return true;
}

bool Matcher::searchNear(size_t q, const SearchCone &cone, Watch *watch, NearestTwo *nearest) const {
  const MapView &map = *map_;
  const Descriptor &query = queries_[q];
  if (watch->passed(kRanking)) return false;
  SectorRun runs[SectorCones::kMaxRuns];
  const uint32_t run_count = cones_.touched(cone.axis, {runs, SectorCones::kMaxRuns});
  DirectionRun gathered[kGathered];
  uint32_t candidates[kCandidates], gathered_count = 0, room = kCandidates;
  const auto compare = [&] {
    // behind the directions lie the descriptors, so reading a few more is safe
    const uint32_t count = findInside(map.directions().data(), {gathered, gathered_count}, cone, candidates);
    searchCandidates(map.descriptors(), {candidates, count}, query, nearest);
    gathered_count = 0;
    room = kCandidates;
  };
  for (const uint16_t cell : cellsOf(q).first(std::min(kGuidedProbes, ranks_)))
    for (uint32_t r = 0; r < run_count && cell != kNoCell; ++r) {
      const IndexRange points = map.sectors(cell, runs[r].first, runs[r].last);
      for (uint32_t at = points.begin; at < points.end;) {
        const uint32_t end = std::min(at + room, points.end);
        if (watch->passed(end - at)) return false;
        gathered[gathered_count++] = {at, end};
        room -= end - at;
        at = end;
        if (room == 0 || gathered_count == kGathered) compare();
      }
    }
  compare();
  return true;
}

uint32_t Matcher::select(Span<const NearestTwo> nearest, float max_ratio, Span<Match> matches) {
  uint32_t n = 0;
  for (uint32_t q = 0; q < nearest.size(); ++q)
    if (passesRatio(nearest[q], max_ratio))
      matches[n++] = {q, nearest[q].best_index, nearest[q].best2, nearest[q].second2};
  // One query for each map point: the nearest.
  std::sort(matches.data(), matches.data() + n, [](const Match &a, const Match &b) {
    if (a.point_index != b.point_index) return a.point_index < b.point_index;
    return a.distance2 != b.distance2 ? a.distance2 < b.distance2 : a.query < b.query;
  });
  n = static_cast<uint32_t>(
      std::unique(matches.data(), matches.data() + n,
                  [](const Match &a, const Match &b) { return a.point_index == b.point_index; }) -
      matches.data());
  std::sort(matches.data(), matches.data() + n, [](const Match &a, const Match &b) {
    const uint64_t left = uint64_t{a.distance2} * b.second2, right = uint64_t{b.distance2} * a.second2;
    return left != right ? left < right : a.query < b.query;
  });
  return n;
}

}  // namespace sphc
