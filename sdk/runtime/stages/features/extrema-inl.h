// Extrema among the 26 neighbours of each sample; compiled once for each instruction set by kernels_simd.cpp, and
// for single lanes by kernels_scalar.cpp.
#if defined(SPHC_FEATURES_EXTREMA_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SPHC_FEATURES_EXTREMA_INL_H
#undef SPHC_FEATURES_EXTREMA_INL_H
#else
#define SPHC_FEATURES_EXTREMA_INL_H
#endif

#include <hwy/highway.h>

#include "runtime/stages/features/config.h"
#include "runtime/stages/features/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace sphc {
namespace HWY_NAMESPACE {
namespace {  // every file that includes this has its own
namespace hn = hwy::HWY_NAMESPACE;

using ExtremaTag = hn::ScalableTag<int16_t>;

// Samples beyond the threshold and their six nearest neighbours.  No branches: whether a vector holds one cannot be
// foretold.
HWY_INLINE hn::Mask<ExtremaTag> beyondNearest(const DogRows &dog, int16_t threshold, int32_t x) {
  const ExtremaTag d;
  const int16_t *const *rows = dog.rows[1];
  const auto v = hn::LoadU(d, rows[1] + x);
  const auto left = hn::LoadU(d, rows[1] + x - 1), right = hn::LoadU(d, rows[1] + x + 1);
  const auto up = hn::LoadU(d, rows[0] + x), down = hn::LoadU(d, rows[2] + x);
  const auto finer = hn::LoadU(d, dog.rows[0][1] + x), coarser = hn::LoadU(d, dog.rows[2][1] + x);
  const auto high_before = hn::Max(hn::Max(left, up), hn::Max(finer, hn::Set(d, threshold)));
  const auto high_after = hn::Max(hn::Max(right, down), coarser);
  const auto low_before = hn::Min(hn::Min(left, up), hn::Min(finer, hn::Set(d, static_cast<int16_t>(-threshold))));
  const auto low_after = hn::Min(hn::Min(right, down), coarser);
  return hn::Or(hn::AndNot(hn::Gt(high_after, v), hn::Gt(v, high_before)),
                hn::AndNot(hn::Gt(v, low_after), hn::Gt(low_before, v)));
}

// The other neighbours: above, below and in the layers beside.
HWY_INLINE bool isBeyondAll(const DogRows &dog, int32_t x) {
  const hn::CappedTag<int16_t, 4> d;
  const int16_t value = dog.rows[1][1][x];
  // ~a orders the other way round: pits become peaks.
  const auto turn = hn::Set(d, static_cast<int16_t>(value < 0 ? -1 : 0));
  const auto v = hn::Xor(hn::Set(d, value), turn);
  bool beyond = true;
  for (int32_t i = 0; i < 3; i += static_cast<int32_t>(hn::Lanes(d))) {
    const auto at = [&](int32_t k, int32_t j) { return hn::Xor(hn::LoadU(d, dog.rows[k][j] + x - 1 + i), turn); };
    const auto before = hn::Max(hn::Max(at(0, 0), at(0, 1)), hn::Max(at(0, 2), at(1, 0)));
    const auto after = hn::Max(hn::Max(at(2, 0), at(2, 1)), hn::Max(at(2, 2), at(1, 2)));
    const auto passes = hn::AndNot(hn::Gt(after, v), hn::Gt(v, before));
    beyond &= hn::AllTrue(d, hn::Or(passes, hn::Not(hn::FirstN(d, static_cast<size_t>(3 - i)))));
  }
  return beyond;
}

HWY_ATTR uint32_t findExtrema(const DogRows &dog, int16_t threshold, int32_t first, int32_t end,
                              uint16_t *HWY_RESTRICT found) {
  const ExtremaTag d;
  // One bit a column.  All are written before any is read: a word just written in pieces is slow to read.
  alignas(64) uint8_t bits[(2 * kMaxImageSide + 512) / 8];
#if HWY_TARGET == HWY_SCALAR
  __builtin_memset(bits, 0, sizeof bits);
  for (int32_t x = first; x < end; ++x) {
    const bool beyond = hn::GetLane(hn::VecFromMask(d, beyondNearest(dog, threshold, x))) != 0;
    bits[(x - first) / 8] |= static_cast<uint8_t>(beyond << ((x - first) % 8));
  }
#else
  const int32_t lanes = static_cast<int32_t>(hn::Lanes(d));
  int32_t x = first;
  for (; x + lanes <= end; x += lanes)
    hn::StoreMaskBits(d, beyondNearest(dog, threshold, x), bits + (x - first) / 8);
  // Samples behind the row's end have any value, so no column there counts, up to the end of the last word.
  __builtin_memset(bits + (x - first) / 8, 0, 64);
  if (x < end) {
    const auto inside = hn::FirstN(d, static_cast<size_t>(end - x));
    hn::StoreMaskBits(d, hn::And(inside, beyondNearest(dog, threshold, x)), bits + (x - first) / 8);
  }
#endif
  uint32_t count = 0;
  for (int32_t begin = first; begin < end; begin += 64) {
    uint64_t word;
    __builtin_memcpy(&word, bits + (begin - first) / 8, sizeof word);
    for (; word != 0; word &= word - 1) {
      const int32_t at = begin + __builtin_ctzll(word);
      if (isBeyondAll(dog, at)) found[count++] = static_cast<uint16_t>(at);
    }
  }
  return count;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sphc
HWY_AFTER_NAMESPACE();

#endif
