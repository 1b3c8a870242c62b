// The SIMD version of search_cone.cpp: the same operations in the same order, a direction a lane.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "runtime/stages/match/search_cone_simd.cpp"
#include <hwy/foreach_target.h>  // keep before highway.h
#include <hwy/highway.h>

#include <algorithm>

#include "runtime/stages/match/search_cone.h"

HWY_BEFORE_NAMESPACE();
namespace sphc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<float, kConeOverread>;
using I = hn::RebindToSigned<F>;
using U = hn::RebindToUnsigned<F>;

HWY_INLINE hn::Vec<F> withSignOf(hn::Vec<F> value, hn::Vec<F> sign) {
  return hn::IfThenElse(hn::Lt(sign, hn::Zero(F())), hn::Neg(value), value);
}

HWY_INLINE hn::Vec<F> centred(hn::Vec<U> coordinate) {
  return hn::ConvertTo(F(), hn::Sub(hn::BitCast(I(), coordinate), hn::Set(I(), 32768)));
}

// A cone in vectors.
struct ConeLanes {
  hn::Vec<F> x, y, z, cosine;
};

// A bit for each of the directions from `first` on, set where it lies inside.
HWY_INLINE uint32_t insideBits(const PackedDirection *first, const ConeLanes &cone) {
  const F f;
  const auto whole = hn::Set(f, 32767.0f);
  const auto packed = hn::LoadU(U(), reinterpret_cast<const uint32_t *>(first));
  const auto u = centred(hn::And(packed, hn::Set(U(), 0xFFFFu))), v = centred(hn::ShiftRight<16>(packed));
  const auto abs_u = hn::Abs(u), abs_v = hn::Abs(v);
  const auto z = hn::Sub(hn::Sub(whole, abs_u), abs_v);
  const auto folded = hn::Lt(z, hn::Zero(f));
  const auto x = hn::IfThenElse(folded, withSignOf(hn::Sub(whole, abs_v), u), u),
             y = hn::IfThenElse(folded, withSignOf(hn::Sub(whole, abs_u), v), v);
  const auto along = hn::Add(hn::Add(hn::Mul(x, cone.x), hn::Mul(y, cone.y)), hn::Mul(z, cone.z));
  const auto length = hn::Sqrt(hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z)));
  uint8_t bits[8] = {};
  hn::StoreMaskBits(f, hn::Gt(along, hn::Mul(cone.cosine, length)), bits);
  return bits[0];
}

uint32_t findInsideSimd(const PackedDirection *directions, Span<const DirectionRun> runs, const SearchCone &cone,
                        uint32_t *inside) {
  const F f;
  const ConeLanes cone_lanes = {hn::Set(f, cone.axis.x), hn::Set(f, cone.axis.y), hn::Set(f, cone.axis.z),
                                hn::Set(f, cone.cosine)};
  const auto lanes = static_cast<uint32_t>(hn::Lanes(f));
  uint32_t count = 0;
  for (const DirectionRun &run : runs)
    for (uint32_t i = run.begin; i < run.end; i += lanes) {
      uint32_t bits = insideBits(directions + i, cone_lanes);
      if (run.end - i < lanes) bits &= (1u << (run.end - i)) - 1;
      for (uint32_t k = 0; bits; ++k, bits >>= 1)
        if (bits & 1) inside[count++] = i + k;
    }
  return count;
}

}  // namespace HWY_NAMESPACE
}  // namespace sphc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sphc {

HWY_EXPORT(findInsideSimd);
uint32_t findInside(const PackedDirection *directions, Span<const DirectionRun> runs, const SearchCone &cone,
                    uint32_t *inside) {
  return HWY_DYNAMIC_DISPATCH(findInsideSimd)(directions, runs, cone, inside);
}

}  // namespace sphc
#endif
