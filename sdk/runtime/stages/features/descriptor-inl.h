// Resampling, pooling and normalisation of a patch; compiled once for each instruction set by kernels_simd.cpp, and
// for single lanes by kernels_scalar.cpp.
#if defined(SPHC_FEATURES_DESCRIPTOR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SPHC_FEATURES_DESCRIPTOR_INL_H
#undef SPHC_FEATURES_DESCRIPTOR_INL_H
#else
#define SPHC_FEATURES_DESCRIPTOR_INL_H
#endif

#include <hwy/highway.h>

#include <initializer_list>

#include "runtime/stages/features/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace sphc {
namespace HWY_NAMESPACE {
namespace {  // every file that includes this has its own
namespace hn = hwy::HWY_NAMESPACE;

using Wide = hn::CappedTag<int32_t, 8>;
using Narrow = hn::CappedTag<int16_t, kPatchSide>;
using Floats = hn::CappedTag<float, 8>;

constexpr int32_t kCells = 4, kBins = 8, kPerCell = 3;
constexpr int32_t kReach = 2 * kPerCell;  // gradient samples along a side that enter a cell
// Shares of a sample in a cell, falling linearly to both sides: 1 3 5 5 3 1 of 18, a sum just below one.
constexpr int16_t kShares[kReach] = {1820, 5461, 9102, 9102, 5461, 1820};
constexpr float kClamp = 0.2f;  // against single strong gradients (Lowe 2004, section 6.1)

// Low half times low half + high half times high half.
HWY_INLINE hn::Vec<Wide> dotOfHalves(hn::Vec<Wide> a, hn::Vec<Wide> b) {
#if HWY_TARGET == HWY_SCALAR
  const auto low = [](hn::Vec<Wide> v) { return hn::ShiftRight<16>(hn::ShiftLeft<16>(v)); };
  return hn::Add(hn::Mul(low(a), low(b)), hn::Mul(hn::ShiftRight<16>(a), hn::ShiftRight<16>(b)));
#else
  const Wide d;
  const hn::Repartition<int16_t, Wide> halves;
  auto rest = hn::Zero(d);
  const auto sum =
      hn::ReorderWidenMulAccumulate(d, hn::BitCast(halves, a), hn::BitCast(halves, b), hn::Zero(d), rest);
  return hn::RearrangeToOddPlusEven(sum, rest);
#endif
}

// Pairs of neighbouring pixels, the left one in the low half.
HWY_INLINE hn::Vec<Wide> pairsAt(const int16_t *pixels, hn::Vec<Wide> offset) {
  const Wide d;
#if HWY_TARGET == HWY_SCALAR
  int32_t pair;
  __builtin_memcpy(&pair, pixels + hn::GetLane(offset), sizeof pair);
  return hn::Set(d, pair);
#else
  return hn::GatherOffset(d, reinterpret_cast<const int32_t *>(pixels), hn::ShiftLeft<1>(offset));
#endif
}

// Weights 1 - f and f, of 2^14, for a fraction of 2^16.
HWY_INLINE hn::Vec<Wide> sharesOf(hn::Vec<Wide> position) {
  const Wide d;
  const auto f = hn::And(hn::ShiftRight<2>(position), hn::Set(d, 0x3FFF));
  return hn::Add(hn::Sub(hn::ShiftLeft<16>(f), f), hn::Set(d, 0x4000));
}

// Bilinear, twice the sample.
HWY_INLINE void samplePatch(const PatchTask &task, int16_t *HWY_RESTRICT patch) {
  const Wide d;
  const hn::Rebind<int16_t, Wide> narrow;
  const auto zero = hn::Zero(d), low_half = hn::Set(d, 0xFFFF);
  const auto last_x = hn::Set(d, (task.width - 1) * 65536 - 1), last_y = hn::Set(d, (task.height - 1) * 65536 - 1);
  const auto stride = hn::Set(d, task.stride);
  for (int32_t i = 0; i < kPatchSide; i += static_cast<int32_t>(hn::Lanes(d))) {
    const auto column = hn::Iota(d, i);
    auto x = hn::Add(hn::Set(d, task.x), hn::Mul(column, hn::Set(d, task.c)));
    auto y = hn::Add(hn::Set(d, task.y), hn::Mul(column, hn::Set(d, task.s)));
    for (int32_t j = 0; j < kPatchSide; ++j) {
      const auto px = hn::Min(hn::Max(x, zero), last_x), py = hn::Min(hn::Max(y, zero), last_y);
      const auto offset = hn::Add(hn::Mul(hn::ShiftRight<16>(py), stride), hn::ShiftRight<16>(px));
      const auto across = sharesOf(px), down = sharesOf(py);
      const auto upper = hn::ShiftRight<14>(dotOfHalves(pairsAt(task.pixels, offset), across));
      const auto lower = hn::ShiftRight<14>(dotOfHalves(pairsAt(task.pixels + task.stride, offset), across));
      const auto both = hn::Or(hn::And(upper, low_half), hn::ShiftLeft<16>(lower));
      hn::StoreU(hn::DemoteTo(narrow, hn::ShiftRight<13>(dotOfHalves(both, down))), narrow,
                 patch + j * kPatchSide + i);
      x = hn::Sub(x, hn::Set(d, task.s));
      y = hn::Add(y, hn::Set(d, task.c));
    }
  }
}

// A gradient as a sum of two of the eight directions, those beside it: no angle and no length is needed.
// out: a row of each direction.
HWY_INLINE void splitGradients(hn::Vec<Narrow> dx, hn::Vec<Narrow> dy, int16_t *HWY_RESTRICT out) {
  const Narrow d;
  const auto zero = hn::Zero(d), root = hn::Set(d, 13573);  // sqrt(2) - 1, of 2^15
  const auto right = hn::Max(dx, zero), left = hn::Max(hn::Neg(dx), zero);
  const auto down = hn::Max(dy, zero), up = hn::Max(hn::Neg(dy), zero);
  const auto ax = hn::Max(left, right), ay = hn::Max(up, down);
  const auto diagonal = [&](hn::Vec<Narrow> a, hn::Vec<Narrow> b) {
    const auto shared = hn::Min(a, b);
    return hn::SaturatedAdd(shared, hn::MulFixedPoint15(shared, root));
  };
  const auto straight = [&](hn::Vec<Narrow> a, hn::Vec<Narrow> b) { return hn::Max(hn::Sub(a, b), zero); };
  hn::Store(straight(right, ay), d, out + 0 * kPatchSide);
  hn::Store(diagonal(right, down), d, out + 1 * kPatchSide);
  hn::Store(straight(down, ax), d, out + 2 * kPatchSide);
  hn::Store(diagonal(left, down), d, out + 3 * kPatchSide);
  hn::Store(straight(left, ay), d, out + 4 * kPatchSide);
  hn::Store(diagonal(left, up), d, out + 5 * kPatchSide);
  hn::Store(straight(up, ax), d, out + 6 * kPatchSide);
  hn::Store(diagonal(right, up), d, out + 7 * kPatchSide);
}

// Gradients between four samples each.
HWY_INLINE void differentiate(const int16_t *HWY_RESTRICT patch, const PatchWindow &window,
                              int16_t *HWY_RESTRICT bins) {
  const Narrow d;
  for (int32_t j = 0; j < kGradientSide; ++j) {
    for (int32_t i = 0; i < kPatchSide; i += static_cast<int32_t>(hn::Lanes(d))) {
      const int16_t *at = patch + j * kPatchSide + i;
      const auto a = hn::Load(d, at), b = hn::LoadU(d, at + 1);
      const auto c = hn::Load(d, at + kPatchSide), e = hn::LoadU(d, at + kPatchSide + 1);
      const auto falling = hn::SaturatedSub(e, a), rising = hn::SaturatedSub(b, c);
      const auto weight = hn::Load(d, window.weights[j] + i);
      const auto dx = hn::MulFixedPoint15(hn::SaturatedAdd(falling, rising), weight);
      const auto dy = hn::MulFixedPoint15(hn::SaturatedSub(falling, rising), weight);
      splitGradients(dx, dy, bins + j * kBins * kPatchSide + i);
    }
  }
}

// The rows of a cell's directions, from those of the samples that enter it.
HWY_INLINE void poolDown(const int16_t *HWY_RESTRICT bins, int16_t *HWY_RESTRICT out) {
  const Narrow d;
  for (int32_t k = 0; k < kBins * kPatchSide; k += static_cast<int32_t>(hn::Lanes(d))) {
    auto sum = hn::Zero(d);
    for (int32_t j = 0; j < kReach; ++j) {
      sum =
          hn::Add(sum, hn::MulFixedPoint15(hn::Load(d, bins + j * kBins * kPatchSide + k), hn::Set(d, kShares[j])));
    }
    hn::Store(sum, d, out + k);
  }
}

// 8 rows of kPatchSide to kPatchSide rows of 8.
HWY_INLINE void transpose(const int16_t *HWY_RESTRICT in, int16_t *HWY_RESTRICT out) {
#if HWY_TARGET == HWY_SCALAR
  for (int32_t i = 0; i < kPatchSide; ++i) {
    for (int32_t k = 0; k < kBins; ++k) out[i * kBins + k] = in[k * kPatchSide + i];
  }
#else
  const hn::FixedTag<int16_t, 8> d;
  const hn::Repartition<int32_t, decltype(d)> d2;
  const hn::Repartition<int64_t, decltype(d)> d4;
  for (int32_t i = 0; i < kPatchSide; i += 8) {
    const auto row = [&](int32_t k) { return hn::Load(d, in + k * kPatchSide + i); };
    const auto twos = [&](int32_t k, bool upper) {
      return hn::BitCast(
          d2, upper ? hn::InterleaveUpper(d, row(k), row(k + 1)) : hn::InterleaveLower(d, row(k), row(k + 1)));
    };
    for (const bool upper : {false, true}) {
      const auto ab = twos(0, upper), cd = twos(2, upper), ef = twos(4, upper), gh = twos(6, upper);
      const auto low = hn::BitCast(d4, hn::InterleaveLower(d2, ab, cd)),
                 low2 = hn::BitCast(d4, hn::InterleaveLower(d2, ef, gh));
      const auto high = hn::BitCast(d4, hn::InterleaveUpper(d2, ab, cd)),
                 high2 = hn::BitCast(d4, hn::InterleaveUpper(d2, ef, gh));
      int16_t *to = out + (i + (upper ? 4 : 0)) * kBins;
      hn::Store(hn::BitCast(d, hn::InterleaveLower(d4, low, low2)), d, to);
      hn::Store(hn::BitCast(d, hn::InterleaveUpper(d4, low, low2)), d, to + kBins);
      hn::Store(hn::BitCast(d, hn::InterleaveLower(d4, high, high2)), d, to + 2 * kBins);
      hn::Store(hn::BitCast(d, hn::InterleaveUpper(d4, high, high2)), d, to + 3 * kBins);
    }
  }
#endif
}

HWY_INLINE void poolAcross(const int16_t *HWY_RESTRICT columns, int16_t *HWY_RESTRICT out) {
  const hn::CappedTag<int16_t, kBins> d;
  for (int32_t c = 0; c < kCells; ++c) {
    for (int32_t k = 0; k < kBins; k += static_cast<int32_t>(hn::Lanes(d))) {
      auto sum = hn::Zero(d);
      for (int32_t i = 0; i < kReach; ++i) {
        const auto column = hn::Load(d, columns + (c * kPerCell + i) * kBins + k);
        sum = hn::Add(sum, hn::MulFixedPoint15(column, hn::Set(d, kShares[i])));
      }
      hn::Store(sum, d, out + c * kBins + k);
    }
  }
}

// Sum in eight fixed lanes: the same order on every machine.
HWY_INLINE float sumOf(const float *lanes) {
  return ((lanes[0] + lanes[4]) + (lanes[2] + lanes[6])) + ((lanes[1] + lanes[5]) + (lanes[3] + lanes[7]));
}

HWY_INLINE void toRootSift(const int16_t *HWY_RESTRICT histogram, Descriptor *out) {
  const Floats d;
  const hn::Rebind<int16_t, Floats> narrow;
  const hn::Rebind<int32_t, Floats> wide;
  constexpr size_t kBytes = kDescriptorBytes;
  alignas(64) float values[kBytes], squares[8], sums[8];
  const size_t lanes = hn::Lanes(d);
  for (size_t k = 0; k < 8; k += lanes) {
    auto sum = hn::Zero(d);
    for (size_t i = k; i < kBytes; i += 8) {
      const auto v = hn::ConvertTo(d, hn::PromoteTo(wide, hn::Load(narrow, histogram + i)));
      hn::Store(v, d, values + i);
      sum = hn::Add(sum, hn::Mul(v, v));
    }
    hn::Store(sum, d, squares + k);
  }
  const auto limit = hn::Set(d, kClamp * __builtin_sqrtf(sumOf(squares)));
  for (size_t k = 0; k < 8; k += lanes) {
    auto sum = hn::Zero(d);
    for (size_t i = k; i < kBytes; i += 8) sum = hn::Add(sum, hn::Min(hn::Load(d, values + i), limit));
    hn::Store(sum, d, sums + k);
  }
  const float total = sumOf(sums);
  const auto scale = hn::Set(d, total > 0.0f ? 512.0f * 512.0f / total : 0.0f);
  const hn::Rebind<uint8_t, Floats> bytes;
  for (size_t i = 0; i < kBytes; i += lanes) {
    const auto clamped = hn::Min(hn::Load(d, values + i), limit);
    const auto root = hn::Add(hn::Sqrt(hn::Mul(clamped, scale)), hn::Set(d, 0.5f));
    hn::StoreU(hn::DemoteTo(bytes, hn::ConvertTo(wide, root)), bytes, out->bytes + i);
  }
}

HWY_ATTR void describePatch(const PatchTask &task, const PatchWindow &window, Descriptor *out) {
  alignas(64) int16_t patch[kPatchSide * kPatchSide + kPatchSide];
  alignas(64) int16_t bins[kGradientSide * kBins * kPatchSide];
  alignas(64) int16_t pooled[kBins * kPatchSide], columns[kPatchSide * kBins], histogram[kDescriptorBytes];
  samplePatch(task, patch);
  patch[kPatchSide * kPatchSide] = 0;  // read with weight zero
  differentiate(patch, window, bins);
  for (int32_t r = 0; r < kCells; ++r) {
    poolDown(bins + r * kPerCell * kBins * kPatchSide, pooled);
    transpose(pooled, columns);
    poolAcross(columns, histogram + r * kCells * kBins);
  }
  toRootSift(histogram, out);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sphc
HWY_AFTER_NAMESPACE();

#endif  // include guard
