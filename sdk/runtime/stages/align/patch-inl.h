// Sums over the surface in a patch, and nearest measurements; compiled once for each instruction set.
#if defined(SPHC_ALIGN_PATCH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SPHC_ALIGN_PATCH_INL_H
#undef SPHC_ALIGN_PATCH_INL_H
#else
#define SPHC_ALIGN_PATCH_INL_H
#endif

#include <hwy/highway.h>

#include "runtime/stages/align/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace sphc {
namespace HWY_NAMESPACE {
namespace {  // every file that includes this has its own

namespace hn = hwy::HWY_NAMESPACE;

constexpr float kSameSurface = 0.025f;  // relative depth difference a pixel away that still is one surface
constexpr size_t kSumCount = 6;         // n, v, vv, q, qv, qq

// The sums of one vector of columns, from the top down.
template <class D>
HWY_ATTR HWY_INLINE void addColumns(D d, const PatchView &patch, size_t lane, hn::Vec<D> across, hn::Vec<D> *sums) {
  const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f), anchor = hn::Set(d, patch.anchor);
  const auto low = hn::Set(d, patch.low), high = hn::Set(d, patch.high), same = hn::Set(d, kSameSurface);
  const auto inside = hn::Lt(across, hn::Set(d, 3.0f));
  const auto away_u = hn::Abs(hn::Sub(across, hn::Set(d, patch.dx)));
  for (size_t k = 0; k < kSumCount; ++k) sums[k] = zero;
  for (int r = 0; r < kFitSide; ++r) {
    const auto integer = hn::LoadU(hn::Rebind<uint16_t, D>(), patch.rows[r] + lane);
    const auto raw = hn::ConvertTo(d, hn::PromoteTo(hn::Rebind<int32_t, D>(), integer));
    const auto valid = hn::And(inside, hn::And(hn::Ge(raw, low), hn::Le(raw, high)));
    const auto v = hn::Set(d, static_cast<float>(r - kFitRadius));
    const auto away = hn::Max(away_u, hn::Abs(hn::Sub(v, hn::Set(d, patch.dy))));
    const auto q = hn::Sub(hn::Div(anchor, hn::IfThenElse(valid, raw, one)), one);
    const auto on = hn::And(valid, hn::Le(hn::Abs(q), hn::Mul(same, hn::Add(one, away))));
    const auto n = hn::IfThenElseZero(on, one), weighted = hn::IfThenElseZero(on, q), nv = hn::Mul(n, v);
    sums[0] = hn::Add(sums[0], n);
    sums[1] = hn::Add(sums[1], nv);
    sums[2] = hn::Add(sums[2], hn::Mul(nv, v));
    sums[3] = hn::Add(sums[3], weighted);
    sums[4] = hn::Add(sums[4], hn::Mul(weighted, v));
    sums[5] = hn::Add(sums[5], hn::Mul(weighted, q));
  }
}

HWY_ATTR void patchSums(const PatchView &patch, PatchSums *out) {
  const hn::CappedTag<float, kFitLanes> d;
  using V = hn::Vec<decltype(d)>;
  alignas(32) static constexpr float kAcross[kFitLanes] = {-2, -1, 0, 1, 2, 99, 99, 99};
  alignas(32) float lanes[kSumCount][kFitLanes];
  for (size_t l = 0; l < kFitLanes; l += hn::Lanes(d)) {
    V sums[kSumCount];
    addColumns(d, patch, l, hn::Load(d, kAcross + l), sums);
    for (size_t k = 0; k < kSumCount; ++k) hn::Store(sums[k], d, lanes[k] + l);
  }
  PatchSums s = {};
  for (int l = 0; l < kFitSide; ++l) {
    const float u = static_cast<float>(l - kFitRadius);
    s.n += lanes[0][l], s.v += lanes[1][l], s.vv += lanes[2][l];
    s.u += u * lanes[0][l], s.uu += u * u * lanes[0][l], s.uv += u * lanes[1][l];
    s.q += lanes[3][l], s.qu += u * lanes[3][l], s.qv += lanes[4][l], s.qq += lanes[5][l];
  }
  *out = s;
}

HWY_ATTR void nearestRow(const uint16_t *raw, uint16_t first, int32_t count, uint16_t *nearest) {
  const hn::ScalableTag<uint16_t> d;
  const auto offset = hn::Set(d, first);
  const int32_t lanes = static_cast<int32_t>(hn::Lanes(d));
  int32_t i = 0;
  for (; i + lanes <= count; i += lanes)
    hn::StoreU(hn::Min(hn::LoadU(d, nearest + i), hn::Sub(hn::LoadU(d, raw + i), offset)), d, nearest + i);
  for (; i < count; ++i) {
    const uint16_t from_first = static_cast<uint16_t>(raw[i] - first);
    if (from_first < nearest[i]) nearest[i] = from_first;
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sphc
HWY_AFTER_NAMESPACE();
#endif
