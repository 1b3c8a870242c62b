// The depth image, 16 bits a pixel; compiled once for each instruction set.
#if defined(SPHC_ALIGN_SENSE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SPHC_ALIGN_SENSE_INL_H
#undef SPHC_ALIGN_SENSE_INL_H
#else
#define SPHC_ALIGN_SENSE_INL_H
#endif

#include <hwy/highway.h>

#include "runtime/stages/align/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace sphc {
namespace HWY_NAMESPACE {
namespace {  // every file that includes this has its own

namespace hn = hwy::HWY_NAMESPACE;

using U16 = hn::CappedTag<uint16_t, kRowPadding>;
using VU16 = hn::Vec<U16>;

constexpr uint16_t kEdgeJump16 = 1966;  // relative depth step to a neighbour that is an edge: 0.03, in 1/65536

HWY_ATTR void senseRow(const uint16_t *raw, uint16_t low, uint16_t high, int32_t count, uint16_t *sensed) {
  const U16 d;
  const int32_t lanes = static_cast<int32_t>(hn::Lanes(d));
  const uint16_t range = static_cast<uint16_t>(high - low);
  const VU16 first = hn::Set(d, low), most = hn::Set(d, range), one = hn::Set(d, 1);
  int32_t u = 0;
  for (; u + lanes <= count; u += lanes) {
    const VU16 row = hn::LoadU(d, raw + u);
    const auto good = hn::Eq(hn::SaturatedSub(hn::Sub(row, first), most), hn::Zero(d));
    hn::StoreU(hn::IfThenElse(good, hn::Sub(row, one), hn::Set(d, kNotSensed)), d, sensed + u);
  }
  for (; u < count; ++u) {
    const bool good = raw[u] >= low && raw[u] <= high;
    sensed[u] = good ? static_cast<uint16_t>(raw[u] - 1) : kNotSensed;
  }
}

// Appends those columns from `u` on whose lanes are true; returns where the next will go.
HWY_ATTR HWY_INLINE int32_t *appendColumns(hn::Mask<U16> which, int32_t u, int32_t *columns) {
  uint8_t bits[8] = {};
  hn::StoreMaskBits(U16(), which, bits);
  for (size_t rest = bits[0] | size_t{bits[1]} << 8; rest; rest &= rest - 1)
    *columns++ = u + static_cast<int32_t>(hwy::Num0BitsBelowLS1Bit_Nonzero64(rest));
  return columns;
}

HWY_ATTR int32_t compareRow(const SensedRows &in, uint16_t *slope, int32_t *edges) {
  const U16 d;
  const VU16 none = hn::Set(d, kNotSensed), jump = hn::Set(d, kEdgeJump16);
  int32_t *edges_end = edges;
  const int32_t count = in.count;
  for (int32_t u = 0; u < count; u += static_cast<int32_t>(hn::Lanes(d))) {
    const VU16 z = hn::LoadU(d, in.here + u);
    const auto missing = hn::Eq(z, none);
    if (hn::AllTrue(d, missing)) continue;
    const VU16 left = hn::LoadU(d, in.here + u - 1), right = hn::LoadU(d, in.here + u + 1);
    const VU16 above = hn::LoadU(d, in.above + u), below = hn::LoadU(d, in.below + u);
    const VU16 farthest = hn::Max(hn::Max(left, right), hn::Max(above, below));
    const VU16 nearest = hn::Min(hn::Min(left, right), hn::Min(above, below));
    const VU16 steepest = hn::Max(hn::SaturatedSub(farthest, z), hn::SaturatedSub(z, nearest));
    hn::StoreU(steepest, d, slope + u);
    if (!edges) continue;
    const VU16 same = hn::SaturatedAdd(z, hn::MulHigh(z, jump));
    if (hn::AllTrue(d, hn::Eq(hn::SaturatedSub(farthest, same), hn::Zero(d)))) continue;
    const uint8_t sides = in.sides[u / kRowPadding];
    VU16 beside = z;
    if (sides & kLeftSide) beside = hn::Max(beside, left);
    if (sides & kRightSide) beside = hn::Max(beside, right);
    if (sides & kUpperSide) beside = hn::Max(beside, above);
    if (sides & kLowerSide) beside = hn::Max(beside, below);
    const auto flat = hn::Eq(hn::SaturatedSub(beside, same), hn::Zero(d));
    edges_end = appendColumns(hn::Not(hn::Or(missing, flat)), u, edges_end);
  }
  return static_cast<int32_t>(edges_end - edges);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sphc
HWY_AFTER_NAMESPACE();
#endif
