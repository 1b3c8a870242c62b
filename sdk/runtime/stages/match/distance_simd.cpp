// The SIMD twins of distance.cpp; Highway compiles this file once for each instruction set and picks at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "runtime/stages/match/distance_simd.cpp"
#include <hwy/foreach_target.h>  // keep before highway.h
#include <hwy/highway.h>

#include "runtime/stages/match/distance.h"

HWY_BEFORE_NAMESPACE();
namespace sphc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

uint32_t distance2Simd(const Descriptor &a, const Descriptor &b) {
  const hn::CappedTag<int16_t, 64> d16;
  const hn::Rebind<uint8_t, decltype(d16)> d8;
  const hn::Repartition<int32_t, decltype(d16)> d32;
  auto low = hn::Zero(d32), high = hn::Zero(d32);
  for (size_t i = 0; i < kDescriptorBytes; i += hn::Lanes(d16)) {
    const auto difference = hn::Sub(hn::PromoteTo(d16, hn::LoadU(d8, a.bytes + i)),  //
                                    hn::PromoteTo(d16, hn::LoadU(d8, b.bytes + i)));
    low = hn::ReorderWidenMulAccumulate(d32, difference, difference, low, high);
  }
  return static_cast<uint32_t>(hn::GetLane(hn::SumOfLanes(d32, hn::Add(low, high))));
}

void searchRangeSimd(Span<const Descriptor> map, uint32_t begin, uint32_t end, Span<const Descriptor> queries,
                     Span<NearestTwo> nearest) {
  for (size_t q = 0; q < queries.size(); ++q)
    for (uint32_t i = begin; i < end; ++i) nearest[q].see(distance2Simd(map[i], queries[q]), i);
}

}  // namespace HWY_NAMESPACE
}  // namespace sphc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sphc {

HWY_EXPORT(distance2Simd);
HWY_EXPORT(searchRangeSimd);

uint32_t distance2(const Descriptor &a, const Descriptor &b) { return HWY_DYNAMIC_DISPATCH(distance2Simd)(a, b); }

void searchRange(Span<const Descriptor> map, uint32_t begin, uint32_t end, Span<const Descriptor> queries,
                 Span<NearestTwo> nearest) {
  HWY_DYNAMIC_DISPATCH(searchRangeSimd)(map, begin, end, queries, nearest);
}

}  // namespace sphc
#endif
