// Extrema among the 26 neighbours of each sample; compiled once for each instruction set by kernels_simd.cpp, and
// for single lanes by kernels_scalar.cpp.
#if defined(SPHC_FEATURES_EXTREMA_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SPHC_FEATURES_EXTREMA_INL_H
#undef SPHC_FEATURES_EXTREMA_INL_H
#else
#define SPHC_FEATURES_EXTREMA_INL_H
#endif

#include <hwy/highway.h>

#include <initializer_list>

#include "runtime/stages/features/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace sphc {
namespace HWY_NAMESPACE {
namespace {  // every file that includes this has its own
namespace hn = hwy::HWY_NAMESPACE;

// What a vector of samples is held against: the largest and smallest of the neighbours before it and after it.
struct Bounds {
  using D = hn::ScalableTag<int16_t>;
  using V = hn::Vec<D>;
  V before_high, before_low, after_high, after_low;

  HWY_INLINE void before(V v) { before_high = hn::Max(before_high, v), before_low = hn::Min(before_low, v); }
  HWY_INLINE void after(V v) { after_high = hn::Max(after_high, v), after_low = hn::Min(after_low, v); }

  // Those of `high` above all and those of `low` below all.
  HWY_INLINE hn::Mask<D> beyond(V v, hn::Mask<D> high, hn::Mask<D> low) const {
    const auto peak = hn::AndNot(hn::Gt(after_high, v), hn::And(high, hn::Gt(v, before_high)));
    const auto pit = hn::AndNot(hn::Gt(v, after_low), hn::And(low, hn::Gt(before_low, v)));
    return hn::Or(peak, pit);
  }
};

HWY_INLINE Bounds::V at(const int16_t *row, int32_t x) { return hn::LoadU(Bounds::D(), row + x); }

// Row and column neighbours, then those in the layers beside, then the corners: most samples fail early.
HWY_INLINE hn::Mask<Bounds::D> extremaAt(const DogRows &dog, int16_t threshold, int32_t x) {
  const Bounds::D d;
  const int16_t *const *rows = dog.rows[1];
  const auto v = at(rows[1], x);
  const auto high = hn::Gt(v, hn::Set(d, threshold));
  const auto low = hn::Gt(hn::Set(d, static_cast<int16_t>(-threshold)), v);
  const auto up = at(rows[0], x), down = at(rows[2], x);
  Bounds bounds = {up, up, down, down};
  bounds.before(at(rows[1], x - 1));
  bounds.after(at(rows[1], x + 1));
  auto found = bounds.beyond(v, high, low);
  if (hn::AllFalse(d, found)) return found;
  bounds.before(at(dog.rows[0][1], x));
  bounds.after(at(dog.rows[2][1], x));
  found = bounds.beyond(v, high, low);
  if (hn::AllFalse(d, found)) return found;
  for (const int32_t side : {-1, 1}) {
    bounds.before(at(rows[0], x + side));
    bounds.after(at(rows[2], x + side));
    for (int32_t j = 0; j < 3; ++j) {
      bounds.before(at(dog.rows[0][j], x + side));
      bounds.after(at(dog.rows[2][j], x + side));
    }
  }
  for (const int32_t j : {0, 2}) {
    bounds.before(at(dog.rows[0][j], x));
    bounds.after(at(dog.rows[2][j], x));
  }
  return bounds.beyond(v, high, low);
}

HWY_ATTR uint32_t findExtrema(const DogRows &dog, int16_t threshold, int32_t first, int32_t end,
                              uint16_t *HWY_RESTRICT found) {
  const Bounds::D d;
  const int32_t lanes = static_cast<int32_t>(hn::Lanes(d));
  uint32_t count = 0;
  for (int32_t x = first; x < end; x += lanes) {
    const auto mask = extremaAt(dog, threshold, x);
    if (HWY_LIKELY(hn::AllFalse(d, mask))) continue;
    uint8_t bits[hn::MaxLanes(d) / 8 + 8];
    hn::StoreMaskBits(d, mask, bits);
    for (int32_t i = 0; i < lanes && x + i < end; ++i) {
      if (bits[i / 8] >> (i % 8) & 1) found[count++] = static_cast<uint16_t>(x + i);
    }
  }
  return count;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sphc
HWY_AFTER_NAMESPACE();

#endif  // include guard
