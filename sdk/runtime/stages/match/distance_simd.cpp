// The SIMD version of distance.cpp; Highway compiles this file once for each instruction set and picks at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "runtime/stages/match/distance_simd.cpp"
#include <hwy/foreach_target.h>  // keep before highway.h
#include <hwy/highway.h>

#include <algorithm>

#include "runtime/stages/match/distance.h"

HWY_BEFORE_NAMESPACE();
namespace sphc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR  // a single lane: nothing fits side by side

uint32_t distance2Simd(const Descriptor &a, const Descriptor &b) { return distance2Scalar(a, b); }

void searchRangeSimd(Span<const Descriptor> map, uint32_t begin, uint32_t end, Span<const Descriptor> queries,
                     Span<const uint32_t> chosen, Span<NearestTwo> nearest) {
  searchRangeScalar(map, begin, end, queries, chosen, nearest);
}

void searchCandidatesSimd(Span<const Descriptor> map, Span<const uint32_t> candidates, const Descriptor &query,
                          NearestTwo *nearest) {
  searchCandidatesScalar(map, candidates, query, nearest);
}

void widenRowsSimd(Span<const Descriptor> rows, Span<WideRow> wide, Span<uint32_t> length2) {
  widenRowsScalar(rows, wide, length2);
}

void rankCellsSimd(const CellTable &table, const Descriptor &query, Span<Ranked> groups, Span<Ranked> cells) {
  rankCellsScalar(table, query, groups, cells);
}

#else

constexpr uint32_t kTile = 128;  // map descriptors that stay in the nearest cache while all queries pass over them
constexpr uint32_t kGroup = 4;   // queries, or candidates, side by side

using D16 = hn::CappedTag<int16_t, 16>;
using D8 = hn::Rebind<uint8_t, D16>;
using D32 = hn::Repartition<int32_t, D16>;
using D4 = hn::FixedTag<int32_t, 4>;
using Sum = hn::Vec<D32>;

// Adds pairs of products of 16-bit lanes.
HWY_INLINE Sum multiplyAdd(hn::Vec<D16> a, hn::Vec<D16> b, Sum sum) {
  Sum high = hn::Zero(D32());
  sum = hn::ReorderWidenMulAccumulate(D32(), a, b, sum, high);
  return hn::Add(sum, high);
}

HWY_INLINE hn::Vec<D16> widen(const uint8_t *bytes) { return hn::PromoteTo(D16(), hn::LoadU(D8(), bytes)); }

HWY_INLINE hn::Vec<D4> foldHalves(hn::Vec<D4> v) { return v; }
#if HWY_MAX_BYTES >= 32
HWY_INLINE hn::Vec<D4> foldHalves(hn::Vec<hn::FixedTag<int32_t, 8> > v) {
  return hn::Add(hn::LowerHalf(D4(), v), hn::UpperHalf(D4(), v));
}
#endif

// The sums of the lanes of four vectors, side by side.
HWY_INLINE hn::Vec<D4> sumsOf(Sum a, Sum b, Sum c, Sum d) {
  const D32 d32;
  const hn::RepartitionToWide<D32> d64;
  const auto ab = hn::BitCast(d64, hn::Add(hn::InterleaveLower(d32, a, b), hn::InterleaveUpper(d32, a, b)));
  const auto cd = hn::BitCast(d64, hn::Add(hn::InterleaveLower(d32, c, d), hn::InterleaveUpper(d32, c, d)));
  return foldHalves(hn::Add(hn::BitCast(d32, hn::InterleaveLower(d64, ab, cd)),
                            hn::BitCast(d32, hn::InterleaveUpper(d64, ab, cd))));
}

// As a lane of 32 bits; no distance comes near its largest value.
HWY_INLINE int32_t asLane(uint32_t distance2) {
  return static_cast<int32_t>(std::min(distance2, static_cast<uint32_t>(INT32_MAX)));
}

uint32_t distance2Simd(const Descriptor &a, const Descriptor &b) {
  Sum sum = hn::Zero(D32());
  for (size_t i = 0; i < kDescriptorBytes; i += hn::Lanes(D16())) {
    const auto difference = hn::Sub(widen(a.bytes + i), widen(b.bytes + i));
    sum = multiplyAdd(difference, difference, sum);
  }
  return static_cast<uint32_t>(hn::GetLane(hn::SumOfLanes(D32(), sum)));
}

HWY_INLINE uint32_t squareLength(const Descriptor &row) {
  Sum sum = hn::Zero(D32());
  for (size_t k = 0; k < kDescriptorBytes; k += hn::Lanes(D16())) {
    const auto v = widen(row.bytes + k);
    sum = multiplyAdd(v, v, sum);
  }
  return static_cast<uint32_t>(hn::GetLane(hn::SumOfLanes(D32(), sum)));
}

// Up to kGroup queries in 16-bit lanes; where there are fewer, the last one is repeated and never sees anything.
struct QueryGroup {
  HWY_ALIGN int16_t lanes[kGroup][kDescriptorBytes];
  HWY_ALIGN int32_t length2[kGroup];
  HWY_ALIGN int32_t second2[kGroup];
  uint32_t index[kGroup];
  uint32_t count;
};

HWY_INLINE void fill(Span<const Descriptor> queries, Span<const uint32_t> chosen, size_t first,
                     Span<NearestTwo> nearest, QueryGroup *group) {
  group->count = static_cast<uint32_t>(std::min<size_t>(kGroup, chosen.size() - first));
  for (uint32_t k = 0; k < kGroup; ++k) {
    const uint32_t q = chosen[first + std::min(k, group->count - 1)];
    group->index[k] = q;
    group->second2[k] = k < group->count ? asLane(nearest[q].second2) : 0;
    for (size_t i = 0; i < kDescriptorBytes; i += hn::Lanes(D16()))
      hn::Store(widen(queries[q].bytes + i), D16(), group->lanes[k] + i);
    group->length2[k] = static_cast<int32_t>(squareLength(queries[q]));
  }
}

// |q - p|^2 = |q|^2 + |p|^2 - 2 q.p
HWY_INLINE hn::Vec<D4> fromProducts(hn::Vec<D4> query2, int32_t point2, hn::Vec<D4> products) {
  return hn::Sub(hn::Add(query2, hn::Set(D4(), point2)), hn::ShiftLeft<1>(products));
}

HWY_INLINE void show(hn::Vec<D4> distances2, uint32_t point, QueryGroup *group, Span<NearestTwo> nearest) {
  if (hn::AllFalse(D4(), hn::Lt(distances2, hn::Load(D4(), group->second2)))) return;
  HWY_ALIGN int32_t each[kGroup];
  hn::Store(distances2, D4(), each);
  for (uint32_t k = 0; k < group->count; ++k) {
    NearestTwo &two = nearest[group->index[k]];
    two.see(static_cast<uint32_t>(each[k]), point);
    group->second2[k] = asLane(two.second2);
  }
}

// Four queries against two points at a time: sixteen products for each load.
HWY_INLINE void searchTile(const Descriptor *rows, uint32_t begin, uint32_t count, const int32_t *length2,
                           QueryGroup *group, Span<NearestTwo> nearest) {
  const D16 d16;
  const auto query2 = hn::Load(D4(), group->length2);
  for (uint32_t i = 0; i < count; i += 2) {
    const uint32_t j = std::min(i + 1, count - 1);
    Sum a0 = hn::Zero(D32()), a1 = a0, a2 = a0, a3 = a0, b0 = a0, b1 = a0, b2 = a0, b3 = a0;
    HWY_UNROLL(2)  // the whole would not fit the registers
    for (size_t k = 0; k < kDescriptorBytes; k += hn::Lanes(d16)) {
      const auto a = widen(rows[i].bytes + k), b = widen(rows[j].bytes + k);
      const auto q0 = hn::Load(d16, group->lanes[0] + k), q1 = hn::Load(d16, group->lanes[1] + k),
                 q2 = hn::Load(d16, group->lanes[2] + k), q3 = hn::Load(d16, group->lanes[3] + k);
      a0 = multiplyAdd(a, q0, a0), a1 = multiplyAdd(a, q1, a1);
      a2 = multiplyAdd(a, q2, a2), a3 = multiplyAdd(a, q3, a3);
      b0 = multiplyAdd(b, q0, b0), b1 = multiplyAdd(b, q1, b1);
      b2 = multiplyAdd(b, q2, b2), b3 = multiplyAdd(b, q3, b3);
    }
    show(fromProducts(query2, length2[i], sumsOf(a0, a1, a2, a3)), begin + i, group, nearest);
    if (j > i) show(fromProducts(query2, length2[j], sumsOf(b0, b1, b2, b3)), begin + j, group, nearest);
  }
}

void searchRangeSimd(Span<const Descriptor> map, uint32_t begin, uint32_t end, Span<const Descriptor> queries,
                     Span<const uint32_t> chosen, Span<NearestTwo> nearest) {
  HWY_ALIGN int32_t length2[kTile];
  QueryGroup group;
  for (; begin < end; begin += kTile) {
    const uint32_t count = std::min(kTile, end - begin);
    for (uint32_t i = 0; i < count; ++i) length2[i] = static_cast<int32_t>(squareLength(map[begin + i]));
    for (size_t first = 0; first < chosen.size(); first += kGroup) {
      fill(queries, chosen, first, nearest, &group);
      searchTile(&map[begin], begin, count, length2, &group, nearest);
    }
  }
}

// A query against four rows at a time.
HWY_INLINE hn::Vec<D4> distancesTo(const uint8_t *const rows[kGroup], const int16_t *query) {
  const D16 d16;
  Sum s0 = hn::Zero(D32()), s1 = s0, s2 = s0, s3 = s0;
  HWY_UNROLL(2)
  for (size_t k = 0; k < kDescriptorBytes; k += hn::Lanes(d16)) {
    const auto q = hn::Load(d16, query + k);
    const auto r0 = hn::Sub(q, widen(rows[0] + k)), r1 = hn::Sub(q, widen(rows[1] + k)),
               r2 = hn::Sub(q, widen(rows[2] + k)), r3 = hn::Sub(q, widen(rows[3] + k));
    s0 = multiplyAdd(r0, r0, s0), s1 = multiplyAdd(r1, r1, s1);
    s2 = multiplyAdd(r2, r2, s2), s3 = multiplyAdd(r3, r3, s3);
  }
  return sumsOf(s0, s1, s2, s3);
}

HWY_INLINE void widenAll(const Descriptor &query, int16_t *lanes) {
  for (size_t i = 0; i < kDescriptorBytes; i += hn::Lanes(D16()))
    hn::StoreU(widen(query.bytes + i), D16(), lanes + i);
}

void searchCandidatesSimd(Span<const Descriptor> map, Span<const uint32_t> candidates, const Descriptor &query,
                          NearestTwo *nearest) {
  HWY_ALIGN int16_t lanes[kDescriptorBytes];
  HWY_ALIGN int32_t each[kGroup];
  widenAll(query, lanes);
  const size_t count = candidates.size();
  for (size_t i = 0; i < count; i += kGroup) {
    const uint8_t *rows[kGroup];
    for (size_t k = 0; k < kGroup; ++k) rows[k] = map[candidates[std::min(i + k, count - 1)]].bytes;
    const auto distances2 = distancesTo(rows, lanes);
    const auto second2 = hn::Set(D4(), asLane(nearest->second2));
    if (hn::AllFalse(D4(), hn::Lt(distances2, second2))) continue;
    hn::Store(distances2, D4(), each);
    for (size_t k = 0; k < kGroup && i + k < count; ++k)
      nearest->see(static_cast<uint32_t>(each[k]), candidates[i + k]);
  }
}

void widenRowsSimd(Span<const Descriptor> rows, Span<WideRow> wide, Span<uint32_t> length2) {
  for (size_t i = 0; i < rows.size(); ++i) {
    widenAll(rows[i], wide[i].lanes);
    length2[i] = static_cast<uint32_t>(squareLength(rows[i]));
  }
}

// The products of a query with four rows.
HWY_INLINE hn::Vec<D4> productsWith(const WideRow *const rows[kGroup], const int16_t *query) {
  const D16 d16;
  Sum s0 = hn::Zero(D32()), s1 = s0, s2 = s0, s3 = s0;
  HWY_UNROLL(4)
  for (size_t k = 0; k < kDescriptorBytes; k += hn::Lanes(d16)) {
    const auto q = hn::Load(d16, query + k);
    s0 = multiplyAdd(q, hn::LoadU(d16, rows[0]->lanes + k), s0);
    s1 = multiplyAdd(q, hn::LoadU(d16, rows[1]->lanes + k), s1);
    s2 = multiplyAdd(q, hn::LoadU(d16, rows[2]->lanes + k), s2);
    s3 = multiplyAdd(q, hn::LoadU(d16, rows[3]->lanes + k), s3);
  }
  return sumsOf(s0, s1, s2, s3);
}

// A query as the ranking wants it.
struct Asker {
  HWY_ALIGN int16_t lanes[kDescriptorBytes];
  int32_t length2;
};

HWY_INLINE void rankFour(const WideRow *const rows[kGroup], const int32_t *length2, uint32_t first, uint32_t count,
                         const Asker &asker, Span<Ranked> best) {
  const auto query2 = hn::Set(D4(), asker.length2);
  const auto distances2 =
      hn::Sub(hn::Add(hn::LoadU(D4(), length2), query2), hn::ShiftLeft<1>(productsWith(rows, asker.lanes)));
  const auto last = hn::Set(D4(), asLane(best[best.size() - 1].distance2));
  if (hn::AllFalse(D4(), hn::Lt(distances2, last))) return;
  HWY_ALIGN int32_t each[kGroup];
  hn::Store(distances2, D4(), each);
  for (uint32_t k = 0; k < count; ++k) rank({static_cast<uint32_t>(each[k]), first + k}, best);
}

HWY_INLINE void rankRows(Span<const WideRow> rows, Span<const uint32_t> length2, uint32_t begin, uint32_t end,
                         const Asker &asker, Span<Ranked> best) {
  uint32_t i = begin;
  for (; i + kGroup <= end; i += kGroup) {
    const WideRow *first = &rows[i];
    const WideRow *four[kGroup] = {first, first + 1, first + 2, first + 3};
    rankFour(four, reinterpret_cast<const int32_t *>(&length2[i]), i, kGroup, asker, best);
  }
  if (i == end) return;
  const WideRow *four[kGroup];
  int32_t rest[kGroup];
  for (uint32_t k = 0; k < kGroup; ++k) {
    const uint32_t row = std::min(i + k, end - 1);
    four[k] = &rows[row];
    rest[k] = static_cast<int32_t>(length2[row]);
  }
  rankFour(four, rest, i, end - i, asker, best);
}

void rankCellsSimd(const CellTable &table, const Descriptor &query, Span<Ranked> groups, Span<Ranked> cells) {
  Asker asker;
  widenAll(query, asker.lanes);
  asker.length2 = static_cast<int32_t>(squareLength(query));
  rankRows(table.groups, table.group_length2, 0, static_cast<uint32_t>(table.groups.size()), asker, groups);
  for (const Ranked &group : groups)
    rankRows(table.cells, table.cell_length2, table.group_begins[group.index], table.group_begins[group.index + 1],
             asker, cells);
}

#endif  // HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace sphc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sphc {

HWY_EXPORT(distance2Simd);
HWY_EXPORT(searchRangeSimd);
HWY_EXPORT(searchCandidatesSimd);
HWY_EXPORT(widenRowsSimd);
HWY_EXPORT(rankCellsSimd);

uint32_t distance2(const Descriptor &a, const Descriptor &b) { return HWY_DYNAMIC_DISPATCH(distance2Simd)(a, b); }

void searchRange(Span<const Descriptor> map, uint32_t begin, uint32_t end, Span<const Descriptor> queries,
                 Span<const uint32_t> chosen, Span<NearestTwo> nearest) {
  HWY_DYNAMIC_DISPATCH(searchRangeSimd)(map, begin, end, queries, chosen, nearest);
}

void searchCandidates(Span<const Descriptor> map, Span<const uint32_t> candidates, const Descriptor &query,
                      NearestTwo *nearest) {
  HWY_DYNAMIC_DISPATCH(searchCandidatesSimd)(map, candidates, query, nearest);
}

void widenRows(Span<const Descriptor> rows, Span<WideRow> wide, Span<uint32_t> length2) {
  HWY_DYNAMIC_DISPATCH(widenRowsSimd)(rows, wide, length2);
}

void rankCells(const CellTable &table, const Descriptor &query, Span<Ranked> groups, Span<Ranked> cells) {
  HWY_DYNAMIC_DISPATCH(rankCellsSimd)(table, query, groups, cells);
}

}  // namespace sphc
#endif
