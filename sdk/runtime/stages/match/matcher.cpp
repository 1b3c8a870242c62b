#include "runtime/stages/match/matcher.h"

#include <algorithm>

namespace sphc {
namespace {

constexpr uint32_t kTile = 128;  // map descriptors that stay in the nearest cache while all queries pass over them
constexpr uint32_t kGuidedProbes = 16;
constexpr uint32_t kCandidates = 64;  // gathered before they are compared

constexpr uint32_t kNobody = UINT32_MAX;
// Two unrelated descriptors are seldom nearer than this; a lone candidate has to beat it by the ratio.
constexpr uint32_t kUnrelated2 = 300 * 300;
constexpr NearestTwo kStart = {kUnrelated2, kUnrelated2, kNobody};
constexpr Ranked kFar = {UINT32_MAX, kNobody};

bool passesRatio(const NearestTwo &nearest, float max_ratio) {
  if (nearest.best_index == kNobody) return false;
  return static_cast<double>(nearest.best2) <
         static_cast<double>(max_ratio) * static_cast<double>(max_ratio) * static_cast<double>(nearest.second2);
}

// Of the groups of cells, those whose cells are looked at.
uint32_t groupsVisited(uint32_t groups) { return std::min(groups, groups / 3 + 4); }

}  // namespace

void Matcher::layout(uint32_t max_queries, Arena &scratch, Matcher *matcher) {
  Matcher discarded;  // receives empty spans while measuring
  Matcher &m = matcher ? *matcher : discarded;
  m.nearest_ = scratch.take<NearestTwo>("match.nearest", max_queries);
  m.probed_ = scratch.take<uint16_t>("match.probed", size_t{max_queries} * kMaxProbes);
  m.starts_ = scratch.take<uint32_t>("match.askers", kMapMaxCells + 1);
  m.askers_ = scratch.take<uint32_t>("match.askers", size_t{max_queries} * kMaxProbes);
  m.cell_length2_ = scratch.take<uint32_t>("match.lengths", kMapMaxCells);
  m.group_length2_ = scratch.take<uint32_t>("match.lengths", kMapMaxGroups);
  SectorCones::layout(scratch, matcher ? &m.cones_ : nullptr);
}

void Matcher::begin(const MapView &map, size_t queries) {
  for (NearestTwo &n : nearest_.first(queries)) n = kStart;
  const Span<uint32_t> cells = cell_length2_.first(map.cellCount()),
                       groups = group_length2_.first(map.groupCount());
  squareLengths(map.centroids(), cells);
  squareLengths(map.groupCentroids(), groups);
  table_ = {map.groupCentroids(), map.centroids(), map.groupBegins(), groups, cells};
}

// The cells nearest to a query, nearest first, by way of the groups that they are in; returns how many.
uint32_t Matcher::chooseCells(const Descriptor &query, uint32_t probes, Span<Ranked> cells) const {
  Ranked near_groups[kMapMaxGroups];
  const Span<Ranked> groups(near_groups, groupsVisited(static_cast<uint32_t>(table_.groups.size())));
  std::fill(groups.begin(), groups.end(), kFar);
  std::fill(cells.begin(), cells.begin() + probes, kFar);
  rankCells(table_, query, groups, cells.first(probes));
  while (probes > 0 && cells[probes - 1].index == kNobody) --probes;
  return probes;
}

// Turns "cells of a query" into "queries of a cell", in the order of the queries.
void Matcher::listByCell(const MapView &map, Span<const Descriptor> queries, uint32_t probes) {
  constexpr uint16_t kNone = UINT16_MAX;
  const Span<uint32_t> starts = starts_.first(map.cellCount() + 1);
  std::fill(starts.begin(), starts.end(), 0u);
  for (size_t q = 0; q < queries.size(); ++q) {
    Ranked cells[kMaxProbes];
    const uint32_t count = chooseCells(queries[q], probes, {cells, kMaxProbes});
    for (uint32_t k = 0; k < probes; ++k) {
      probed_[q * probes + k] = k < count ? static_cast<uint16_t>(cells[k].index) : kNone;
      if (k < count) ++starts[cells[k].index];
    }
  }
  uint32_t sum = 0;
  for (uint32_t &start : starts) {
    sum += start;
    start = sum;
  }
  for (size_t at = queries.size() * probes; at > 0; --at)  // backwards, so that the starts end where they should
    if (probed_[at - 1] != kNone) askers_[--starts[probed_[at - 1]]] = static_cast<uint32_t>((at - 1) / probes);
}

uint32_t Matcher::matchAll(const MapView &map, Span<const Descriptor> queries, float max_ratio, uint32_t probes,
                           Span<Match> matches) {
  begin(map, queries.size());
  listByCell(map, queries, std::min(std::max(probes, 1u), std::min(kMaxProbes, map.cellCount())));
  for (uint32_t c = 0; c < map.cellCount(); ++c) {
    const Span<const uint32_t> askers(askers_.data() + starts_[c], starts_[c + 1] - starts_[c]);
    if (askers.empty()) continue;
    const IndexRange points = map.cell(c);
    searchRange(map.descriptors(), points.begin, points.end, queries, askers, nearest_);
  }
  return select(queries.size(), max_ratio, matches);
}

uint32_t Matcher::matchExact(const MapView &map, Span<const Descriptor> queries, float max_ratio,
                             Span<Match> matches) {
  begin(map, queries.size());
  const Span<uint32_t> all = askers_.first(queries.size());
  for (size_t q = 0; q < queries.size(); ++q) all[q] = static_cast<uint32_t>(q);
  for (uint32_t first = 0; first < map.pointCount(); first += kTile)
    searchRange(map.descriptors(), first, std::min(first + kTile, map.pointCount()), queries, all, nearest_);
  return select(queries.size(), max_ratio, matches);
}

uint32_t Matcher::matchNear(const MapView &map, Span<const Descriptor> queries, Span<const Direction> expected,
                            float cap_cosine, float max_ratio, Span<Match> matches) {
  begin(map, queries.size());
  cones_.prepare(map.sectorSide());
  for (size_t q = 0; q < queries.size(); ++q) searchNear(map, queries[q], {expected[q], cap_cosine}, &nearest_[q]);
  return select(queries.size(), max_ratio, matches);
}

void Matcher::searchNear(const MapView &map, const Descriptor &query, const Cap &cap, NearestTwo *nearest) const {
  Ranked cells[kMaxProbes];
  SectorRun runs[SectorCones::kMaxRuns];
  const uint32_t run_count = cones_.touched(cap, {runs, SectorCones::kMaxRuns});
  const uint32_t cell_count = chooseCells(query, std::min(kGuidedProbes, map.cellCount()), {cells, kMaxProbes});
  uint32_t candidates[2 * kCandidates], count = 0;
  const auto compare = [&] {
    searchCandidates(map.descriptors(), {candidates, count}, query, nearest);
    count = 0;
  };
  for (uint32_t c = 0; c < cell_count; ++c)
    for (uint32_t r = 0; r < run_count; ++r) {
      const IndexRange points = map.sectors(cells[c].index, runs[r].first, runs[r].last);
      for (uint32_t at = points.begin; at < points.end; at += kCandidates) {
        // behind the directions lie the descriptors, so reading a few more is safe
        const DirectionRun run = {at, std::min(at + kCandidates, points.end)};
        count += findInside(map.directions().data(), run, cap, candidates + count);
        if (count >= kCandidates) compare();
      }
    }
  compare();
}

uint32_t Matcher::select(size_t queries, float max_ratio, Span<Match> matches) {
  uint32_t n = 0;
  for (uint32_t q = 0; q < queries; ++q)
    if (passesRatio(nearest_[q], max_ratio))
      matches[n++] = {q, nearest_[q].best_index, nearest_[q].best2, nearest_[q].second2};
  // One query for each map point: the nearest.
  std::sort(matches.data(), matches.data() + n, [](const Match &a, const Match &b) {
    if (a.map_index != b.map_index) return a.map_index < b.map_index;
    return a.distance2 != b.distance2 ? a.distance2 < b.distance2 : a.query < b.query;
  });
  n = static_cast<uint32_t>(std::unique(matches.data(), matches.data() + n,
                                        [](const Match &a, const Match &b) { return a.map_index == b.map_index; }) -
                            matches.data());
  std::sort(matches.data(), matches.data() + n, [](const Match &a, const Match &b) {
    const uint64_t left = uint64_t{a.distance2} * b.second2, right = uint64_t{b.distance2} * a.second2;
    return left != right ? left < right : a.query < b.query;
  });
  return n;
}

}  // namespace sphc
