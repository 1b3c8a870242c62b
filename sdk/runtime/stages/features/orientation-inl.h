// Directions of gradients; compiled once for each instruction set by kernels_simd.cpp, and for single lanes by
// kernels_scalar.cpp.
#if defined(SPHC_FEATURES_ORIENTATION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SPHC_FEATURES_ORIENTATION_INL_H
#undef SPHC_FEATURES_ORIENTATION_INL_H
#else
#define SPHC_FEATURES_ORIENTATION_INL_H
#endif

#include <hwy/highway.h>

#include <initializer_list>

#include "runtime/stages/features/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace sphc {
namespace HWY_NAMESPACE {
namespace {  // every file that includes this has its own
namespace hn = hwy::HWY_NAMESPACE;

using Reals = hn::CappedTag<float, 8>;
using Real = hn::Vec<Reals>;

// atan on [0, 1], in eighths of a circle, to 1e-6 of them: an odd polynomial, whose coefficients are by reweighted
// least squares (Lawson).
HWY_INLINE Real eighthsOf(Real t) {
  const Reals d;
  const auto s = hn::Mul(t, t);
  auto p = hn::Set(d, 0.00359517f);
  for (const float a :
       {-0.02031696f, 0.05411891f, -0.09535296f, 0.13540637f, -0.18083489f, 0.25455493f, -0.42441041f}) {
    p = hn::Add(hn::Mul(p, s), hn::Set(d, a));
  }
  return hn::Add(hn::Mul(hn::Mul(p, s), t), hn::Mul(t, hn::Set(d, 1.27323954f)));
}

// Angle of (x, y) in eighths of a circle, [0, 8].
HWY_INLINE Real angleOf(Real x, Real y) {
  const Reals d;
  const auto zero = hn::Zero(d);
  const auto ax = hn::Abs(x), ay = hn::Abs(y);
  const auto big = hn::Max(ax, ay), small = hn::Min(ax, ay);
  auto a = eighthsOf(hn::Div(small, hn::Add(big, hn::Set(d, 1e-30f))));
  a = hn::IfThenElse(hn::Gt(ay, ax), hn::Sub(hn::Set(d, 2.0f), a), a);
  a = hn::IfThenElse(hn::Lt(x, zero), hn::Sub(hn::Set(d, 4.0f), a), a);
  return hn::IfThenElse(hn::Lt(y, zero), hn::Sub(hn::Set(d, 8.0f), a), a);
}

HWY_INLINE Real difference(const int16_t *a, const int16_t *b) {
  const hn::Rebind<int16_t, Reals> narrow;
  const hn::Rebind<int32_t, Reals> wide;
  return hn::ConvertTo(
      Reals(), hn::Sub(hn::PromoteTo(wide, hn::LoadU(narrow, a)), hn::PromoteTo(wide, hn::LoadU(narrow, b))));
}

HWY_ATTR void orientationHistogram(const OrientationWindow &window, float histogram[kOrientationBins]) {
  const Reals d;
  const hn::Rebind<int32_t, Reals> integers;
  const auto bins_per_eighth = hn::Set(d, kOrientationBins * 0.125f), half = hn::Set(d, 0.5f);
  // Two, for neighbouring columns: one addition need not wait for the other.
  float sums[2][kOrientationBins + 1] = {};
  alignas(32) float length[kWindowLanes];
  alignas(32) int32_t bin[kWindowLanes];
  for (int32_t j = 0; j < window.rows; ++j) {
    const int16_t *row = window.pixels + static_cast<int64_t>(j) * window.stride;
    const auto down = hn::Set(d, window.down[j]);
    for (int32_t i = 0; i < window.columns; i += static_cast<int32_t>(hn::Lanes(d))) {
      const auto dx = difference(row + i + 1, row + i - 1);
      const auto dy = difference(row + i + window.stride, row + i - window.stride);
      const auto weight = hn::Mul(down, hn::LoadU(d, window.across + i));
      hn::Store(hn::Mul(weight, hn::Sqrt(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)))), d, length + i);
      hn::Store(hn::ConvertTo(integers, hn::Add(hn::Mul(angleOf(dx, dy), bins_per_eighth), half)), integers,
                bin + i);
    }
    for (int32_t i = 0; i < window.columns; ++i) sums[i & 1][bin[i]] += length[i];
  }
  for (int32_t i = 0; i < kOrientationBins; ++i) histogram[i] = sums[0][i] + sums[1][i];
  histogram[0] += sums[0][kOrientationBins] + sums[1][kOrientationBins];  // rounded up to a full turn
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sphc
HWY_AFTER_NAMESPACE();

#endif
