// Depth pixels to colour pixels; compiled once for each instruction set.
#if defined(SPHC_ALIGN_PROJECT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SPHC_ALIGN_PROJECT_INL_H
#undef SPHC_ALIGN_PROJECT_INL_H
#else
#define SPHC_ALIGN_PROJECT_INL_H
#endif

#include <hwy/highway.h>

#include "runtime/stages/align/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace sphc {
namespace HWY_NAMESPACE {
namespace {  // every file that includes this has its own

namespace hn = hwy::HWY_NAMESPACE;

using F32 = hn::CappedTag<float, kRowPadding>;
using I32 = hn::Rebind<int32_t, F32>;
using U32 = hn::Rebind<uint32_t, F32>;
using VF = hn::Vec<F32>;
using MF = hn::Mask<F32>;
using VU32 = hn::Vec<U32>;

constexpr float kSteepest = 0.1f;    // relative depth step beyond which a neighbour says nothing more
constexpr float kGoodError = 0.01f;  // relative depth error of half the highest confidence
constexpr float kPlacedPx = 0.3f;    // 1 sigma of where in its pixel a sample was measured
constexpr float kSpreadPx = 0.8f;    // the same beside its pixel
constexpr float kFarPx = 1e6f;       // a pixel of numbers that are too large, or not numbers
// Numbers up to 2^22, of either sign, added to it are rounded to whole ones, which are then the low bits.
constexpr float kWhole = 12582912.0f;
constexpr uint32_t kWholeBits = 0x4B400000;
constexpr float kWholeDepth = 8388608.0f;  // the same for numbers from 0 on; all its bits are in the highest 9

// a + s * b, rounded twice.
HWY_ATTR HWY_INLINE VF madd(VF a, float s, VF b) { return hn::Add(a, hn::Mul(hn::Set(F32(), s), b)); }

// Polynomial in t, highest coefficient last.
template <size_t N>
HWY_ATTR HWY_INLINE VF polynomial(const float (&c)[N], VF t) {
  VF value = hn::Set(F32(), c[N - 1]);
  for (size_t i = N - 1; i-- > 0;) value = hn::Add(hn::Mul(value, t), hn::Set(F32(), c[i]));
  return value;
}

// Chebyshev fit of atan(x) / x in x^2 over [0, 1], to 1.2e-8; beyond 1 by atan(x) = pi/2 - atan(1/x).
HWY_ATTR HWY_INLINE VF arcTangent(VF x) {
  static constexpr float kFit[] = {0.999999984f,   -0.333330668f, 0.199924836f,   -0.142025705f, 0.106367541f,
                                   -0.0749544544f, 0.0425876075f, -0.0160050305f, 0.0028340643f};
  const F32 d;
  const VF one = hn::Set(d, 1.0f);
  const auto steep = hn::Gt(x, one);
  const VF t = hn::IfThenElse(steep, hn::Div(one, x), x);
  const VF angle = hn::Mul(t, polynomial(kFit, hn::Mul(t, t)));
  return hn::IfThenElse(steep, hn::Sub(hn::Set(d, 1.57079632679f), angle), angle);
}

struct Point2 {
  VF x, y;
};

HWY_ATTR HWY_INLINE Point2 distortBrown(const LensF &lens, Point2 p, VF r2) {
  const float *k = lens.k;
  const float up[] = {1, k[0], k[1], k[4]}, down[] = {1, k[5], k[6], k[7]};
  VF radial = polynomial(up, r2);
  if (lens.model == SPHC_CAMERA_BROWN8) radial = hn::Div(radial, polynomial(down, r2));
  const F32 d;
  const VF two = hn::Set(d, 2.0f), xy2 = hn::Mul(two, hn::Mul(p.x, p.y));
  const VF xx = hn::Add(r2, hn::Mul(two, hn::Mul(p.x, p.x))), yy = hn::Add(r2, hn::Mul(two, hn::Mul(p.y, p.y)));
  return {madd(madd(hn::Mul(p.x, radial), k[2], xy2), k[3], xx),
          madd(madd(hn::Mul(p.y, radial), k[2], yy), k[3], xy2)};
}

HWY_ATTR HWY_INLINE Point2 distortKannalaBrandt(const LensF &lens, Point2 p, VF r2) {
  const float *k = lens.k;
  const float fit[] = {1, k[0], k[1], k[2], k[3]};
  const F32 d;
  const VF r = hn::Sqrt(r2), theta = arcTangent(r);
  const VF bent = hn::Mul(theta, polynomial(fit, hn::Mul(theta, theta)));
  const VF scale = hn::IfThenElse(hn::Gt(r, hn::Set(d, 1e-6f)), hn::Div(bent, r), hn::Set(d, 1.0f));
  return {hn::Mul(p.x, scale), hn::Mul(p.y, scale)};
}

template <sphc_camera_model kModel>
HWY_ATTR HWY_INLINE Point2 colorPixel(const LensF &lens, Point2 p, VF r2) {
  if constexpr (kModel == SPHC_CAMERA_BROWN8) p = distortBrown(lens, p, r2);
  if constexpr (kModel == SPHC_CAMERA_KANNALA_BRANDT4) p = distortKannalaBrandt(lens, p, r2);
  const F32 d;
  return {madd(hn::Set(d, lens.cx), lens.fx, p.x), madd(hn::Set(d, lens.cy), lens.fy, p.y)};
}

HWY_ATTR HWY_INLINE VF floatOf(const uint16_t *from) {
  const hn::Rebind<uint16_t, F32> d16;
  return hn::ConvertTo(F32(), hn::PromoteTo(I32(), hn::LoadU(d16, from)));
}

HWY_ATTR HWY_INLINE VF halfWidth(const uint8_t *table) {
  const hn::Rebind<uint8_t, F32> bytes;
  const VF sixteenths = hn::ConvertTo(F32(), hn::PromoteTo(I32(), hn::LoadU(bytes, table)));
  return hn::Mul(sixteenths, hn::Set(F32(), 1 / kFootprintsPerPixel));
}

// What every sample of a row needs: numbers in all lanes.
struct Constants {
  VF offset[3], t[3];          // RowToProject's and ProjectTask's
  VF least_depth, most_depth;  // subunits
  VF sigma, sigma_per_raw2, good2, placed2, spread2, steepest;
  VF left, right, top, bottom;  // of the image: centres of the pixels just outside
  VF whole, whole_depth, one, every_doubt, no_sample;
  VU32 stride, origin, nowhere, byte;
};

HWY_ATTR HWY_INLINE Constants constantsOf(const ProjectTask &task, const RowToProject &in) {
  const F32 d;
  const U32 du;
  Constants c;
  for (int i = 0; i < 3; ++i) c.offset[i] = hn::Set(d, in.offset[i]), c.t[i] = hn::Set(d, task.t[i]);
  c.least_depth = hn::Set(d, 1.0f * kSubUnits), c.most_depth = hn::Set(d, task.most_subunits);
  c.sigma = hn::Set(d, task.sigma), c.sigma_per_raw2 = hn::Set(d, task.sigma_per_raw2);
  c.good2 = hn::Set(d, kGoodError * kGoodError), c.placed2 = hn::Set(d, kPlacedPx * kPlacedPx);
  c.spread2 = hn::Set(d, kSpreadPx * kSpreadPx), c.steepest = hn::Set(d, kSteepest);
  c.left = c.top = hn::Set(d, -1.0f);
  c.right = hn::Set(d, task.color.width), c.bottom = hn::Set(d, task.color.height);
  c.whole = hn::Set(d, kWhole), c.whole_depth = hn::Set(d, kWholeDepth);
  c.one = hn::Set(d, 1.0f), c.every_doubt = hn::Set(d, 255.0f), c.no_sample = hn::Set(d, 65535.5f);
  c.stride = hn::Set(du, task.plane_stride);
  c.origin =
      hn::Set(du, task.plane_origin - kWholeBits * (task.plane_stride + 1));  // wraps around, as the sum does
  c.nowhere = hn::Iota(du, task.plane_rest);
  c.byte = hn::Set(du, 255);
  return c;
}

// kWholeBits + the whole number nearest to a value of at most 2^22; of others nothing useful.
HWY_ATTR HWY_INLINE VU32 wholeBits(const Constants &c, VF value) {
  return hn::BitCast(U32(), hn::Add(value, c.whole));
}

// Depth, in subunits, and 255 - confidence.  With e the relative error confidence is 255 / (1 + (e / good)^2), so
// this is 255 e^2 / (good^2 + e^2).  good2, error2: both times the squared depth.
HWY_ATTR HWY_INLINE hn::Vec<I32> keyOf(const Constants &c, VF subunits, VF good2, VF error2) {
  const VF doubt = hn::Div(hn::Mul(c.every_doubt, error2), hn::Add(good2, error2));
  const VU32 depth = hn::BitCast(U32(), hn::Add(subunits, c.whole_depth));
  return hn::BitCast(I32(), hn::Or(hn::ShiftLeft<kDepthShift>(depth), hn::And(wholeBits(c, doubt), c.byte)));
}

// Index in the z-buffer of the pixel whose centre is nearest.
HWY_ATTR HWY_INLINE VU32 indexOf(const Constants &c, VF x, VF y) {
  return hn::Add(hn::Mul(wholeBits(c, y), c.stride), hn::Add(wholeBits(c, x), c.origin));
}

// Pixels [first, last) along one axis that a footprint is spread over: those whose centres are in it.
struct Extent {
  VF first, last;
};
HWY_ATTR HWY_INLINE Extent extentOf(VF middle, VF half, VF less, float most) {
  const F32 d;
  const VF first = hn::Ceil(hn::Sub(middle, half)), last = hn::Ceil(hn::Add(middle, half));
  return {hn::Max(first, hn::Sub(hn::Zero(d), less)),
          hn::Min(hn::Max(hn::Sub(last, less), hn::Add(first, less)), hn::Set(d, most))};
}

// A vector of samples as the colour camera sees them.  Here the centre of the first pixel is at (0, 0).
struct Seen {
  VF subunits;
  Point2 px;
  MF valid;
};

template <sphc_camera_model kModel>
HWY_ATTR HWY_INLINE Seen seenFrom(const ProjectTask &task, const Constants &c, const RowToProject &in, int32_t u,
                                  VF z) {
  const F32 d;
  const auto along = [&](int axis) HWY_ATTR {
    return hn::Add(hn::Mul(z, hn::Add(hn::LoadU(d, in.turned[axis] + u), c.offset[axis])), c.t[axis]);
  };
  Seen seen;
  seen.subunits = along(2);
  const VF inverse = hn::Div(c.one, seen.subunits);
  seen.px = {hn::Mul(along(0), inverse), hn::Mul(along(1), inverse)};
  seen.valid = hn::And(hn::Lt(z, c.no_sample),
                       hn::And(hn::Ge(seen.subunits, c.least_depth), hn::Le(seen.subunits, c.most_depth)));
  if constexpr (kModel != SPHC_CAMERA_PINHOLE) {
    const VF r2 = hn::Add(hn::Mul(seen.px.x, seen.px.x), hn::Mul(seen.px.y, seen.px.y));
    seen.valid = hn::And(seen.valid, hn::Le(r2, hn::Set(d, task.color.max_radius2)));
    seen.px = colorPixel<kModel>(task.color, seen.px, r2);
  }
  return seen;
}

// Samples into single pixels.  What falls beside the image goes into the pixels around it, which nobody reads.
HWY_ATTR HWY_INLINE void place(const Constants &c, const Seen &seen, hn::Vec<I32> key, uint32_t *indices,
                               int32_t *keys) {
  const U32 du;
  const VU32 index =
      indexOf(c, hn::Min(hn::Max(seen.px.x, c.left), c.right), hn::Min(hn::Max(seen.px.y, c.top), c.bottom));
  hn::StoreU(hn::IfThenElse(hn::RebindMask(du, seen.valid), index, c.nowhere), du, indices);
  hn::StoreU(key, I32(), keys);
}

// Samples over their footprints.
HWY_ATTR HWY_INLINE void spread(const ProjectTask &task, const Constants &c, const Seen &seen, hn::Vec<I32> key,
                                VF half_x, VF half_y, const ProjectedRow &out) {
  const F32 d;
  const U32 du;
  const I32 di;
  const VF far = hn::Set(d, kFarPx), less = hn::Set(d, task.grown ? 1.0f : 0.0f);
  const Extent x = extentOf(seen.px.x, half_x, less, task.color.width);
  const Extent y = extentOf(seen.px.y, half_y, less, task.color.height);
  const MF near = hn::And(hn::And(seen.valid, hn::Gt(half_x, hn::Zero(d))),
                          hn::And(hn::Lt(hn::Abs(seen.px.x), far), hn::Lt(hn::Abs(seen.px.y), far)));
  const MF inside = hn::And(near, hn::And(hn::Lt(x.first, x.last), hn::Lt(y.first, y.last)));
  const VF shape = hn::Add(hn::Mul(hn::Sub(y.last, y.first), hn::Set(d, 65536.0f)), hn::Sub(x.last, x.first));
  const VU32 whole_shape = hn::Sub(wholeBits(c, shape), hn::Set(du, kWholeBits));
  const auto inside_u = hn::RebindMask(du, inside);
  hn::StoreU(hn::IfThenElse(inside_u, indexOf(c, x.first, y.first), c.nowhere), du, out.spread_index + out.count);
  hn::StoreU(hn::BitCast(di, hn::IfThenElse(inside_u, whole_shape, hn::Set(du, kOnePixel))), di,
             out.spread_shape + out.count);
  hn::StoreU(key, di, out.spread_key + out.count);
}

template <sphc_camera_model kModel>
HWY_ATTR void projectRowOf(const ProjectTask &shared_task, const RowToProject &row, ProjectedRow *projected) {
  const ProjectTask task = shared_task;  // own copies, which no store through a pointer can change
  const RowToProject in = row;
  ProjectedRow out = *projected;
  const F32 d;
  const hn::Rebind<uint16_t, F32> d16;
  const Constants c = constantsOf(task, in);
  const int32_t lanes = static_cast<int32_t>(hn::Lanes(d));
  out.count = 0;
  for (int32_t u = 0; u < in.count; u += lanes) {
    if (hn::AllTrue(d16, hn::Eq(hn::LoadU(d16, in.sensed + u), hn::Set(d16, kNotSensed)))) continue;
    const VF z = hn::Add(floatOf(in.sensed + u), c.one), z2 = hn::Mul(z, z);
    const Seen seen = seenFrom<kModel>(task, c, in, u, z);
    const VF slope = hn::Min(floatOf(in.slope + u), hn::Mul(c.steepest, z)), slope2 = hn::Mul(slope, slope);
    const VF sigma = hn::Add(c.sigma, hn::Mul(c.sigma_per_raw2, z2)), sigma2 = hn::Mul(sigma, sigma);
    const VF good2 = hn::Mul(c.good2, z2), error2 = hn::Add(sigma2, hn::Mul(c.placed2, slope2));
    place(c, seen, keyOf(c, seen.subunits, good2, error2), out.index + out.count, out.key + out.count);
    if (task.with_footprints) {
      const VF spread_error2 = hn::Add(sigma2, hn::Mul(c.spread2, slope2));
      const auto key = keyOf(c, seen.subunits, good2, spread_error2);
      spread(task, c, seen, key, halfWidth(in.half_x + u), halfWidth(in.half_y + u), out);
    }
    out.count += lanes;
  }
  projected->count = out.count;
}

HWY_ATTR void projectRow(const ProjectTask &task, const RowToProject &in, ProjectedRow *out) {
  switch (task.color.model) {
    case SPHC_CAMERA_PINHOLE:
      return projectRowOf<SPHC_CAMERA_PINHOLE>(task, in, out);
    case SPHC_CAMERA_KANNALA_BRANDT4:
      return projectRowOf<SPHC_CAMERA_KANNALA_BRANDT4>(task, in, out);
    default:  // Brown 5 is Brown 8 with a constant denominator
      return projectRowOf<SPHC_CAMERA_BROWN8>(task, in, out);
  }
}

HWY_ATTR void turnRow(const float *m, const float *ray_x, const float *ray_y, int32_t count, float *const *turned) {
  const F32 d;
  for (int32_t u = 0; u < count; u += static_cast<int32_t>(hn::Lanes(d))) {
    const VF x = hn::LoadU(d, ray_x + u), y = hn::LoadU(d, ray_y + u);
    for (int i = 0; i < 3; ++i)
      hn::StoreU(madd(madd(hn::Set(d, m[3 * i + 2]), m[3 * i + 1], y), m[3 * i], x), d, turned[i] + u);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sphc
HWY_AFTER_NAMESPACE();
#endif
