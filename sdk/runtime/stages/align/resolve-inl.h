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

constexpr int kSameShift = 5;  // depths within 1/32 of each other are one surface

// Every other sample, then the rest: a footprint does not wait for the one just written.
HWY_ATTR void spreadRow(const ProjectedRow &in, int32_t count, int32_t stride, int32_t *top_left) {
  const hn::CappedTag<int32_t, 4> d;
  const int32_t lanes = static_cast<int32_t>(hn::Lanes(d));
  const auto iota = hn::Iota(d, 0), empty = hn::Set(d, kEmpty);
  for (int32_t start = 0; start < 2; ++start) {
    for (int32_t u = start; u < count; u += 2) {
      const auto key = hn::Set(d, in.fill_key[u]);
      for (int32_t x = in.left[u]; x < in.right[u]; x += lanes) {
        const auto put = hn::IfThenElse(hn::Lt(iota, hn::Set(d, in.right[u] - x)), key, empty);
        int32_t *to = top_left + static_cast<int64_t>(in.top[u]) * stride + x;
        for (int32_t y = in.top[u]; y < in.bottom[u]; ++y, to += stride)
          hn::StoreU(hn::Min(hn::LoadU(d, to), put), d, to);
      }
    }
  }
}

HWY_ATTR HWY_INLINE VK depthOf(VK key) {
  return hn::ShiftRight<kDepthShift>(hn::And(key, hn::Set(Key(), kFilledBit - 1)));
}
HWY_ATTR HWY_INLINE MK isThere(VK key) { return hn::Lt(key, hn::Set(Key(), kShadowed)); }

HWY_ATTR void combineRow(const int32_t *measured, const int32_t *spread, int32_t count, int32_t *combined) {
  const Key d;
  for (int32_t x = 0; x < count; x += static_cast<int32_t>(hn::Lanes(d))) {
    const VK m = hn::LoadU(d, measured + x), s = hn::LoadU(d, spread + x);
    const VK near = hn::Sub(depthOf(m), hn::ShiftRight<kSameShift>(depthOf(m)));
    const MK covered = hn::And(isThere(s), hn::Or(hn::Not(isThere(m)), hn::Lt(depthOf(s), near)));
    hn::StoreU(hn::IfThenElse(covered, hn::Or(s, hn::Set(d, kFilledBit)), m), d, combined + x);
  }
}

// Is `other` on the surface of depth `depth`?  Never where it is empty, whose depth is beyond all others.
HWY_ATTR HWY_INLINE MK isSameSurface(VK depth, VK other) {
  const VK apart = hn::Abs(hn::Sub(depth, depthOf(other)));
  return hn::Not(hn::Gt(apart, hn::ShiftRight<kSameShift>(depth)));
}

// Mean depth, the lower confidence, filled.
HWY_ATTR HWY_INLINE VK between(VK a, VK b) {
  const Key d;
  const VK low = hn::Set(d, 255), depth = hn::ShiftRight<1>(hn::Add(depthOf(a), depthOf(b)));
  const VK doubt = hn::Max(hn::And(a, low), hn::And(b, low));
  return hn::Or(hn::Or(hn::ShiftLeft<kDepthShift>(depth), doubt), hn::Set(d, kFilledBit));
}

// The pixels beside one.
struct Around {
  VK left, right, above, below;
};

// A crack one pixel wide in one surface.
HWY_ATTR HWY_INLINE VK closeCrack(VK here, const Around &a) {
  const MK open = hn::Not(isThere(here));
  const MK across = hn::And(open, hn::And(isThere(a.left), isSameSurface(depthOf(a.left), a.right)));
  const MK down = hn::And(open, hn::And(isThere(a.above), isSameSurface(depthOf(a.above), a.below)));
  return hn::IfThenElse(across, between(a.left, a.right), hn::IfThenElse(down, between(a.above, a.below), here));
}

// Footprints are flat; the mean with those beside, of one surface, is nearer to their interpolation.
HWY_ATTR HWY_INLINE VK smoothDepth(VK here, const Around &a) {
  const Key d;
  const hn::Rebind<float, Key> df;
  const VK depth = depthOf(here), others[] = {a.left, a.right, a.above, a.below};
  VK sum = depth, count = hn::Set(d, 1);
  for (const VK &other : others) {
    const MK same = isSameSurface(depth, other);
    sum = hn::Add(sum, hn::IfThenElseZero(same, depthOf(other)));
    count = hn::Sub(count, hn::VecFromMask(d, same));  // a lane that is true is -1
  }
  return hn::ConvertTo(d, hn::Div(hn::ConvertTo(df, sum), hn::ConvertTo(df, count)));
}

HWY_ATTR void resolveRow(const ResolvedRow &in) {
  const Key d;
  const hn::Rebind<uint16_t, Key> d16;
  const hn::Rebind<uint8_t, Key> d8;
  const VK zero = hn::Zero(d), low = hn::Set(d, 255);
  for (int32_t x = 0; x < in.count; x += static_cast<int32_t>(hn::Lanes(d))) {
    VK here = hn::LoadU(d, in.here + x);
    VK depth = depthOf(here);
    MK filled = hn::Gt(here, hn::Set(d, kFilledBit - 1));
    if (!hn::AllFalse(d, filled)) {  // empty ones too
      const Around around = {hn::LoadU(d, in.here + x - 1), hn::LoadU(d, in.here + x + 1),
                             hn::LoadU(d, in.above + x), hn::LoadU(d, in.below + x)};
      here = closeCrack(here, around);
      filled = hn::And(filled, isThere(here));
      depth = hn::IfThenElse(filled, smoothDepth(here, around), depthOf(here));
    }
    const MK there = isThere(here);
    depth = hn::ShiftRight<6>(hn::Add(depth, hn::Set(d, kSubUnits / 2)));
    const MK shadowed = hn::Eq(here, hn::Set(d, kShadowed));
    const VK kind = hn::IfThenElse(
        there, hn::IfThenElse(filled, hn::Set(d, SPHC_ALIGNED_FILLED), hn::Set(d, SPHC_ALIGNED_MEASURED)),
        hn::IfThenElseZero(shadowed, hn::Set(d, SPHC_ALIGNED_OCCLUDED)));
    const VK confidence = hn::Sub(low, hn::And(here, low));
    hn::StoreU(hn::DemoteTo(d16, hn::IfThenElse(there, depth, zero)), d16, in.depth + x);
    hn::StoreU(hn::DemoteTo(d8, kind), d8, in.mask + x);
    hn::StoreU(hn::DemoteTo(d8, hn::IfThenElse(there, confidence, zero)), d8, in.confidence + x);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sphc
HWY_AFTER_NAMESPACE();
#endif
