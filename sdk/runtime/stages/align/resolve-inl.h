// The z-buffer: footprints into it, and from it depth, mask and confidence; compiled once for each instruction set.
#if defined(SPHC_ALIGN_RESOLVE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SPHC_ALIGN_RESOLVE_INL_H
#undef SPHC_ALIGN_RESOLVE_INL_H
#else
#define SPHC_ALIGN_RESOLVE_INL_H
#endif

#include <hwy/highway.h>

#include "runtime/stages/align/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace sphc {
namespace HWY_NAMESPACE {
namespace {  // every file that includes this has its own

namespace hn = hwy::HWY_NAMESPACE;

using Key = hn::CappedTag<int32_t, kRowPadding>;
using VK = hn::Vec<Key>;
using MK = hn::Mask<Key>;
using Pixels = hn::CappedTag<uint16_t, kRowPadding>;
using VP = hn::Vec<Pixels>;
using MP = hn::Mask<Pixels>;

constexpr int kSameShift = 5;  // depths within 1/32 of each other are one surface
constexpr uint16_t kMeasured16 = SPHC_ALIGNED_MEASURED << kKindShift;
constexpr uint16_t kFilled16 = SPHC_ALIGNED_FILLED << kKindShift;
constexpr uint16_t kOccluded16 = SPHC_ALIGNED_OCCLUDED << kKindShift;  // all bits of a kind

HWY_ATTR HWY_INLINE void spreadOne(int32_t key, int32_t shape, int32_t stride, int32_t *to) {
  if (shape == kOnePixel) {
    const int32_t before = *to;
    *to = key < before ? key : before;
    return;
  }
  const hn::CappedTag<int32_t, 4> d;
  const int32_t lanes = static_cast<int32_t>(hn::Lanes(d)), columns = shape & 0xFFFF;
  const auto iota = hn::Iota(d, 0), every = hn::Set(d, key), empty = hn::Set(d, kEmpty);
  for (int32_t rows = shape >> 16; rows > 0; --rows, to += stride) {
    for (int32_t x = 0; x < columns; x += lanes) {
      const auto put = hn::IfThenElse(hn::Lt(iota, hn::Set(d, columns - x)), every, empty);
      hn::StoreU(hn::Min(hn::LoadU(d, to + x), put), d, to + x);
    }
  }
}

// Four quarters of the row in turn: a footprint does not wait for the one just written.
HWY_ATTR void spreadRow(const ProjectedRow &in, int32_t stride, int32_t *plane) {
  const int32_t quarter = in.count / 4;
  const auto put = [&](int32_t i) HWY_ATTR {
    spreadOne(in.spread_key[i], in.spread_shape[i], stride, plane + in.spread_index[i]);
  };
  for (int32_t i = 0; i < quarter; ++i)
    for (int32_t part = 0; part < 4; ++part) put(i + part * quarter);
  for (int32_t i = 4 * quarter; i < in.count; ++i) put(i);
}

// The depth of an empty pixel is larger than any other.
HWY_ATTR HWY_INLINE VK depthOf(VK key) {
  return hn::ShiftRight<kDepthShift>(hn::And(key, hn::Set(Key(), kFilledBit - 1)));
}

// The nearest of what was spread over pixels; where footprints are to grow, of the pixels left and above too.
HWY_ATTR HWY_INLINE VK spreadAt(const BufferRow &in, int32_t x) {
  const Key d;
  const VK here = hn::LoadU(d, in.spread + x);
  if (!in.grown) return here;
  const VK above = hn::Min(hn::LoadU(d, in.spread_above + x), hn::LoadU(d, in.spread_above + x - 1));
  return hn::Min(hn::Min(here, hn::LoadU(d, in.spread + x - 1)), above);
}

HWY_ATTR HWY_INLINE VK combine(VK measured, VK spread) {
  const VK depth = depthOf(measured), near = hn::Sub(depth, hn::ShiftRight<kSameShift>(depth));
  return hn::IfThenElse(hn::Lt(depthOf(spread), near), hn::Or(spread, hn::Set(Key(), kFilledBit)), measured);
}

// Depth of a key without flags in whole units, rounded.
HWY_ATTR HWY_INLINE VK unitsOf(VK key) {
  const VK half = hn::Set(Key(), 1 << (kDepthShift + kSubUnitShift - 1));
  return hn::ShiftRight<kDepthShift + kSubUnitShift>(hn::Add(key, half));
}

HWY_ATTR HWY_INLINE void decode(VK key, VK *depth, VK *state) {
  const Key d;
  const VK low = hn::Set(d, 255), measured = hn::Set(d, kMeasured16), flags = hn::Set(d, kFilledBit);
  if (hn::AllTrue(d, hn::Lt(key, flags))) {
    *depth = unitsOf(key);
    *state = hn::Or(hn::AndNot(key, low), measured);
    return;
  }
  *depth = *state = hn::Zero(d);
  if (hn::AllTrue(d, hn::Eq(key, hn::Set(d, kEmpty)))) return;
  const MK there = hn::Lt(key, hn::Set(d, kShadowed));
  const VK filled = hn::And(hn::ShiftRight<30 - kKindShift>(key), measured);  // the kind after it
  const VK known = hn::Or(hn::Add(measured, filled), hn::AndNot(key, low));
  const VK hidden = hn::IfThenElseZero(hn::Eq(key, hn::Set(d, kShadowed)), hn::Set(d, kOccluded16));
  *depth = hn::IfThenElseZero(there, unitsOf(hn::AndNot(flags, key)));
  *state = hn::IfThenElse(there, known, hidden);
}

HWY_ATTR void decodeRow(const BufferRow &shared_in, const DecodedRow &shared_out) {
  const BufferRow in = shared_in;  // own copies, which no store through a pointer can change
  const DecodedRow out = shared_out;
  const Key d;
  const hn::Rebind<uint16_t, Key> d16;
  const VK empty = hn::Set(d, kEmpty);
  for (int32_t x = 0; x < in.count; x += static_cast<int32_t>(hn::Lanes(d))) {
    VK key = hn::LoadU(d, in.measured + x), depth, state;
    hn::StoreU(empty, d, in.measured + x);
    if (in.spread) key = combine(key, spreadAt(in, x));
    decode(key, &depth, &state);
    hn::StoreU(hn::DemoteTo(d16, depth), d16, out.depth + x);
    hn::StoreU(hn::DemoteTo(d16, state), d16, out.state + x);
  }
}

HWY_ATTR HWY_INLINE VP apart(VP a, VP b) { return hn::Or(hn::SaturatedSub(a, b), hn::SaturatedSub(b, a)); }

// Are two depths, of which the first is not 0, on one surface?
HWY_ATTR HWY_INLINE MP isSameSurface(VP depth, VP other) {
  const VP beyond = hn::SaturatedSub(apart(depth, other), hn::ShiftRight<kSameShift>(depth));
  return hn::Eq(beyond, hn::Zero(Pixels()));
}

// Depth and state of pixels.
struct Resolved {
  VP depth, state;
};
HWY_ATTR HWY_INLINE Resolved loadPixels(const DecodedRow &row, int32_t x) {
  return {hn::LoadU(Pixels(), row.depth + x), hn::LoadU(Pixels(), row.state + x)};
}

// Between two pixels of one surface: mean depth, the lower confidence, filled.
HWY_ATTR HWY_INLINE void closeBetween(const Resolved &a, const Resolved &b, MP open, Resolved *here) {
  const Pixels d;
  const VP low = hn::Set(d, 255), confidence = hn::Min(hn::And(a.state, low), hn::And(b.state, low));
  const MP crack = hn::And(open, hn::AndNot(hn::Eq(a.depth, hn::Zero(d)), isSameSurface(a.depth, b.depth)));
  here->depth = hn::IfThenElse(crack, hn::AverageRound(a.depth, b.depth), here->depth);
  here->state = hn::IfThenElse(crack, hn::Or(confidence, hn::Set(d, kFilled16)), here->state);
}

// Footprints are flat; the mean with those beside, of one surface, is nearer to their interpolation.
HWY_ATTR HWY_INLINE VP smoothDepth(VP depth, const VP (&others)[4]) {
  const Pixels d;
  const hn::RebindToSigned<Pixels> di;
  VP sum = hn::Zero(d), count = hn::Set(d, 1);  // of differences; at most 4/32 of the depth
  for (const VP &other : others) {
    const VP same = hn::VecFromMask(d, isSameSurface(depth, other));
    sum = hn::Add(sum, hn::And(same, hn::Sub(other, depth)));
    count = hn::Sub(count, same);  // a lane that is true is -1
  }
  const auto share = [&](uint16_t n) HWY_ATTR { return hn::Set(d, static_cast<uint16_t>((32768 + n / 2) / n)); };
  VP part = hn::IfThenElse(hn::Eq(count, hn::Set(d, 5)), share(5), share(4));
  part = hn::IfThenElse(hn::Eq(count, hn::Set(d, 3)), share(3), part);
  part = hn::IfThenElse(hn::Eq(count, hn::Set(d, 2)), share(2), part);
  return hn::Add(depth, hn::BitCast(d, hn::MulFixedPoint15(hn::BitCast(di, sum), hn::BitCast(di, part))));
}

HWY_ATTR HWY_INLINE void storePixels(const Resolved &pixels, const ResolvedRow &out, int32_t x) {
  const Pixels d;
  const hn::RebindToSigned<Pixels> di;
  const hn::Rebind<uint8_t, Pixels> d8;
  hn::StoreU(pixels.depth, d, out.depth + x);
  hn::StoreU(hn::DemoteTo(d8, hn::BitCast(di, hn::ShiftRight<kKindShift>(pixels.state))), d8, out.mask + x);
  hn::StoreU(hn::DemoteTo(d8, hn::BitCast(di, hn::And(pixels.state, hn::Set(d, 255)))), d8, out.confidence + x);
}

HWY_ATTR HWY_INLINE void closeCracks(const ResolvedRow &row, int32_t x, MP open, Resolved *here) {
  closeBetween(loadPixels(row.above, x), loadPixels(row.below, x), open, here);
  closeBetween(loadPixels(row.here, x - 1), loadPixels(row.here, x + 1), open, here);
}

// Is nothing in a vector of pixels, and nothing to close?  More than one lane: of three beside each other two are
// in the vector.
HWY_ATTR HWY_INLINE bool isVoid(const ResolvedRow &row, int32_t x, MP open) {
  const Pixels d;
  if (hn::Lanes(d) == 1 || !hn::AllTrue(d, open)) return false;
  const VP both = hn::Min(hn::LoadU(d, row.above.depth + x), hn::LoadU(d, row.below.depth + x));
  return hn::AllTrue(d, hn::Eq(both, hn::Zero(d)));
}

HWY_ATTR void resolveRow(const ResolvedRow &shared_row) {
  const ResolvedRow row = shared_row;  // an own copy, which no store through a pointer can change
  const Pixels d;
  const VP kind = hn::Set(d, kOccluded16), filled = hn::Set(d, kFilled16);
  for (int32_t x = 0; x < row.count; x += static_cast<int32_t>(hn::Lanes(d))) {
    Resolved here = loadPixels(row.here, x);
    const MP open = hn::Eq(here.depth, hn::Zero(d));
    if (!hn::AllFalse(d, open) && !isVoid(row, x, open)) closeCracks(row, x, open, &here);
    const MP is_filled = hn::Eq(hn::And(here.state, kind), filled);
    if (!hn::AllFalse(d, is_filled)) {
      const VP others[] = {hn::LoadU(d, row.here.depth + x - 1), hn::LoadU(d, row.here.depth + x + 1),
                           hn::LoadU(d, row.above.depth + x), hn::LoadU(d, row.below.depth + x)};
      here.depth = hn::IfThenElse(is_filled, smoothDepth(here.depth, others), here.depth);
    }
    storePixels(here, row, x);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sphc
HWY_AFTER_NAMESPACE();
#endif
