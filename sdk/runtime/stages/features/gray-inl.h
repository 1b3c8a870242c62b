// Colour to grey; compiled once for each instruction set by kernels_simd.cpp, and for single lanes by
// kernels_scalar.cpp.
#if defined(SPHC_FEATURES_GRAY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SPHC_FEATURES_GRAY_INL_H
#undef SPHC_FEATURES_GRAY_INL_H
#else
#define SPHC_FEATURES_GRAY_INL_H
#endif

#include <hwy/highway.h>

#include "runtime/stages/features/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace sphc {
namespace HWY_NAMESPACE {
namespace {  // every file that includes this has its own
namespace hn = hwy::HWY_NAMESPACE;

// Three or four bytes a pixel, of which the fourth is not read.
HWY_ATTR void grayRow(const uint8_t *HWY_RESTRICT color, int32_t pixel_bytes, bool red_first,
                      uint8_t *HWY_RESTRICT gray, int32_t width) {
  const hn::ScalableTag<uint16_t> d;
  const hn::Rebind<uint8_t, decltype(d)> bytes;
  const int32_t lanes = static_cast<int32_t>(hn::Lanes(d));
  const uint16_t first = red_first ? 77 : 29, last = red_first ? 29 : 77;
  int32_t x = 0;
  for (; x + lanes <= width; x += lanes) {
    auto r = hn::Undefined(bytes), g = r, b = r, any = r;
    if (pixel_bytes == 3)
      hn::LoadInterleaved3(bytes, color + 3 * x, r, g, b);
    else
      hn::LoadInterleaved4(bytes, color + 4 * x, r, g, b, any);
    const auto product = [&](decltype(r) v, uint16_t weight) {
      return hn::Mul(hn::PromoteTo(d, v), hn::Set(d, weight));
    };
    const auto sum =
        hn::Add(hn::Add(product(r, first), product(g, 150)), hn::Add(product(b, last), hn::Set(d, 128)));
    const auto shifted = hn::BitCast(hn::RebindToSigned<decltype(d)>(), hn::ShiftRight<8>(sum));
    hn::StoreU(hn::DemoteTo(bytes, shifted), bytes, gray + x);
  }
  for (; x < width; ++x) {
    const uint8_t *pixel = color + pixel_bytes * x;
    const int32_t sum = first * pixel[0] + 150 * pixel[1] + last * pixel[2] + 128;
    gray[x] = static_cast<uint8_t>(sum >> 8);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sphc
HWY_AFTER_NAMESPACE();

#endif
