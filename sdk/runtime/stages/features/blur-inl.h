// Rows of the scale space; compiled once for each instruction set by kernels_simd.cpp, and for single lanes by
// kernels_scalar.cpp.
#if defined(SPHC_FEATURES_BLUR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SPHC_FEATURES_BLUR_INL_H
#undef SPHC_FEATURES_BLUR_INL_H
#else
#define SPHC_FEATURES_BLUR_INL_H
#endif

#include <hwy/highway.h>

#include "runtime/stages/features/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace sphc {
namespace HWY_NAMESPACE {
namespace {  // every file that includes this has its own
namespace hn = hwy::HWY_NAMESPACE;

using Samples = hn::ScalableTag<int16_t>;

HWY_ATTR void scaleRow(const uint8_t *HWY_RESTRICT in, int16_t *HWY_RESTRICT out, int32_t width) {
  for (int32_t x = 0; x < width; ++x) out[x] = static_cast<int16_t>((in[x] - kGrayMiddle) * kSampleScale);
}

HWY_ATTR void doubleRow(const uint8_t *HWY_RESTRICT upper, const uint8_t *HWY_RESTRICT lower,
                        int16_t *HWY_RESTRICT out, int32_t width) {
  constexpr int32_t kTwo = kSampleScale / 2, kFour = kSampleScale / 4;
  for (int32_t x = 0; x + 1 < width; ++x) {
    const int32_t here = upper[x] + lower[x], next = upper[x + 1] + lower[x + 1];
    out[2 * x] = static_cast<int16_t>((here - 2 * kGrayMiddle) * kTwo);
    out[2 * x + 1] = static_cast<int16_t>((here + next - 4 * kGrayMiddle) * kFour);
  }
  out[2 * width - 2] = out[2 * width - 1] =
      static_cast<int16_t>((upper[width - 1] + lower[width - 1] - 2 * kGrayMiddle) * kTwo);
}

HWY_ATTR void halveRow(const int16_t *HWY_RESTRICT in, int16_t *HWY_RESTRICT out, int32_t width) {
  for (int32_t x = 0; x < width; ++x) out[x] = in[2 * x];
}

// Two rows at once read hardly more than one.
template <int32_t Radius, int32_t Count>
HWY_ATTR void blurDown(const BlurTask &task, int16_t *const (&out)[kRowsAtOnce]) {
  const Samples d;
  hn::Vec<Samples> weights[Radius + 1];
  const int16_t *rows[2 * Radius + Count];
  for (int32_t k = 0; k <= Radius; ++k) weights[k] = hn::Set(d, task.weights[k]);
  for (int32_t k = 0; k < 2 * Radius + Count; ++k) rows[k] = task.rows[k];
  for (int32_t x = 0; x < task.width; x += static_cast<int32_t>(hn::Lanes(d))) {
    hn::Vec<Samples> sums[Count];
    for (int32_t i = 0; i < Count; ++i) {
      sums[i] = hn::MulFixedPoint15(hn::Load(d, rows[Radius + i] + x), weights[0]);
      for (int32_t k = 1; k <= Radius; ++k) {
        const auto pair = hn::Add(hn::Load(d, rows[Radius + i - k] + x), hn::Load(d, rows[Radius + i + k] + x));
        sums[i] = hn::Add(sums[i], hn::MulFixedPoint15(pair, weights[k]));
      }
    }
    for (int32_t i = 0; i < Count; ++i) hn::Store(sums[i], d, out[i] + x);
  }
}

// Sums of products with a weight, of 32 bits, of the even samples of a vector and of the odd ones.
struct Sums {
#if HWY_TARGET == HWY_SCALAR
  int32_t sum;

  static HWY_INLINE Sums start() { return {kOneQ15 / 2}; }
  HWY_INLINE void add(hn::Vec<Samples> v, int16_t weight) { sum += hn::GetLane(v) * weight; }
  HWY_INLINE hn::Vec<Samples> rounded() const { return hn::Set(Samples(), static_cast<int16_t>(sum >> 15)); }
#else
  using Wide = hn::RepartitionToWide<Samples>;
  hn::Vec<Wide> even, odd;

  static HWY_INLINE Sums start() { return {hn::Set(Wide(), kOneQ15 / 2), hn::Set(Wide(), kOneQ15 / 2)}; }
  HWY_INLINE void add(hn::Vec<Samples> v, int16_t weight) {
    const auto low = hn::BitCast(Samples(), hn::Set(Wide(), weight));  // and zero in the high half
    const auto high = hn::BitCast(Samples(), hn::Set(Wide(), weight * 65536));
    even = hn::Add(even, dotOfHalves(v, low));
    odd = hn::Add(odd, dotOfHalves(v, high));
  }
  HWY_INLINE hn::Vec<Samples> rounded() const {
    return hn::OddEven(hn::BitCast(Samples(), hn::ShiftLeft<1>(odd)),
                       hn::BitCast(Samples(), hn::ShiftRight<15>(even)));
  }
  // Low half times low half + high half times high half.
  static HWY_INLINE hn::Vec<Wide> dotOfHalves(hn::Vec<Samples> a, hn::Vec<Samples> b) {
    auto rest = hn::Zero(Wide());
    const auto sum = hn::ReorderWidenMulAccumulate(Wide(), a, b, hn::Zero(Wide()), rest);
    return hn::RearrangeToOddPlusEven(sum, rest);
  }
#endif
};

// Rounded only once: rounding errors of this pass, unlike those of the other, are not smoothed by another one.
template <int32_t Radius>
HWY_ATTR void blurAcross(const BlurTask &task, int32_t i, const int16_t *HWY_RESTRICT in) {
  const Samples d;
  const int16_t *below = task.rows[Radius + i];
  int16_t *out = task.out[i], *difference = task.difference[i];
  int16_t weights[Radius + 1];
  for (int32_t k = 0; k <= Radius; ++k) weights[k] = task.weights[k];
  for (int32_t x = 0; x < task.width; x += static_cast<int32_t>(hn::Lanes(d))) {
    Sums sums = Sums::start();
    sums.add(hn::Load(d, in + x), weights[0]);
    for (int32_t k = 1; k <= Radius; ++k) {
      sums.add(hn::Add(hn::LoadU(d, in + x - k), hn::LoadU(d, in + x + k)), weights[k]);
    }
    const auto sum = sums.rounded();
    hn::Store(sum, d, out + x);
    if (difference) hn::Store(hn::Sub(sum, hn::Load(d, below + x)), d, difference + x);
  }
}

template <int32_t Radius>
HWY_ATTR void blurWith(const BlurTask &task) {
  int16_t *middle[kRowsAtOnce];
  for (int32_t i = 0; i < kRowsAtOnce; ++i) {
    middle[i] = task.padded + kRowStep + i * (paddedWidth(task.width) + 2 * kRowStep);
  }
  task.count == 2 ? blurDown<Radius, 2>(task, middle) : blurDown<Radius, 1>(task, middle);
  for (int32_t i = 0; i < task.count; ++i) {
    int16_t *row = middle[i];
    for (int32_t k = 1; k <= Radius; ++k) {
      row[-k] = row[0];
      row[task.width - 1 + k] = row[task.width - 1];
    }
    blurAcross<Radius>(task, i, row);
  }
}

HWY_ATTR void blurRows(const BlurTask &task) {
  switch (task.radius) {
    case 1:
      return blurWith<1>(task);
    case 2:
      return blurWith<2>(task);
    case 3:
      return blurWith<3>(task);
    case 4:
      return blurWith<4>(task);
    case 5:
      return blurWith<5>(task);
    case 6:
      return blurWith<6>(task);
    default:
      return blurWith<7>(task);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sphc
HWY_AFTER_NAMESPACE();

#endif  // include guard
