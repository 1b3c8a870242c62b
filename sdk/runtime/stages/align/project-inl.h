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
constexpr float kGoodError = 0.01f;  // relative depth error of confidence 127
constexpr float kPlacedPx = 0.3f;    // 1 sigma of where in its pixel a sample was measured
constexpr float kSpreadPx = 0.8f;    // the same beside its pixel
constexpr float kFarPx = 1e6f;       // a pixel of numbers that are too large, or not numbers
// Numbers up to 2^22 added to it are rounded to whole ones, which are then the low bits.
constexpr float kWhole = 12582912.0f;
constexpr uint32_t kWholeBits = 0x4B400000;

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

// kWholeBits + the whole number nearest to a value of at most 2^22; of others nothing useful.
HWY_ATTR HWY_INLINE VU32 wholeBits(VF value) {
  return hn::BitCast(U32(), hn::Add(value, hn::Set(F32(), kWhole)));
}

// Depth, in subunits, and 255 - confidence.  With e the relative error confidence is 255 / (1 + (e / good)^2), so
// this is 255 e^2 / (good^2 + e^2).  good2, error2: both times the squared depth.
HWY_ATTR HWY_INLINE hn::Vec<I32> keyOf(VF subunits, VF good2, VF error2) {
  const F32 d;
  const U32 du;
  const VF doubt = hn::Div(hn::Mul(hn::Set(d, 255.0f), error2), hn::Add(good2, error2));
  const VU32 low = hn::And(wholeBits(doubt), hn::Set(du, 255));
  const VU32 high = hn::And(hn::ShiftLeft<kDepthShift>(wholeBits(subunits)), hn::Set(du, kFilledBit - 1));
  return hn::BitCast(I32(), hn::Or(high, low));
}

// Index of a pixel in the z-buffer; `column` and `row` are whole.
HWY_ATTR HWY_INLINE VU32 indexOf(const ProjectTask &task, VF column, VF row) {
  const U32 d;
  const VU32 of_row = hn::Mul(wholeBits(row), hn::Set(d, task.plane_stride));
  const uint32_t origin = task.plane_origin - kWholeBits * (task.plane_stride + 1);  // wraps around, as the sum does
  return hn::Add(hn::Add(of_row, wholeBits(column)), hn::Set(d, origin));
}

// First pixel whose centre is not before `edge`.
HWY_ATTR HWY_INLINE VF firstFrom(VF edge) { return hn::Ceil(hn::Sub(edge, hn::Set(F32(), 0.5f))); }

// Pixels [first, last) along one axis that a footprint is spread over.
struct Extent {
  VF first, last;
};
HWY_ATTR HWY_INLINE Extent extentOf(VF middle, VF half, bool grown, float most) {
  const F32 d;
  const VF less = hn::Set(d, grown ? 1.0f : 0.0f);
  const VF first = firstFrom(hn::Sub(middle, half)), last = firstFrom(hn::Add(middle, half));
  return {hn::Max(first, hn::Sub(hn::Zero(d), less)),
          hn::Min(hn::Max(hn::Sub(last, less), hn::Add(first, less)), hn::Set(d, most))};
}

// A vector of samples as the colour camera sees them.
struct Seen {
  VF subunits;
  Point2 px;
  MF valid;
};

template <sphc_camera_model kModel>
HWY_ATTR HWY_INLINE Seen seenFrom(const ProjectTask &task, const RowToProject &in, int32_t u, VF z) {
  const F32 d;
  const auto along = [&](int axis) HWY_ATTR {
    const VF turned = hn::Add(hn::LoadU(d, in.turned[axis] + u), hn::Set(d, in.offset[axis]));
    return hn::Add(hn::Mul(z, turned), hn::Set(d, task.t[axis]));
  };
  Seen seen;
  seen.subunits = along(2);
  const VF inverse = hn::Div(hn::Set(d, 1.0f), seen.subunits);
  seen.px = {hn::Mul(along(0), inverse), hn::Mul(along(1), inverse)};
  seen.valid = hn::And(hn::Lt(z, hn::Set(d, 65535.5f)), hn::And(hn::Ge(seen.subunits, hn::Set(d, 1.0f * kSubUnits)),
                                                  hn::Le(seen.subunits, hn::Set(d, task.most_subunits))));
  if constexpr (kModel != SPHC_CAMERA_PINHOLE) {
    const VF r2 = hn::Add(hn::Mul(seen.px.x, seen.px.x), hn::Mul(seen.px.y, seen.px.y));
    seen.valid = hn::And(seen.valid, hn::Le(r2, hn::Set(d, task.color.max_radius2)));
    seen.px = colorPixel<kModel>(task.color, seen.px, r2);
  }
  return seen;
}

// Samples into single pixels; those that fall into none go to `nowhere`.
HWY_ATTR HWY_INLINE void place(const ProjectTask &task, const Seen &seen, hn::Vec<I32> key, VU32 nowhere,
                               uint32_t *indices, int32_t *keys) {
  const F32 d;
  const U32 du;
  const VF zero = hn::Zero(d);
  const Point2 &px = seen.px;
  const MF inside =
      hn::And(hn::And(seen.valid, hn::And(hn::Ge(px.x, zero), hn::Lt(px.x, hn::Set(d, task.color.width)))),
              hn::And(hn::Ge(px.y, zero), hn::Lt(px.y, hn::Set(d, task.color.height))));
  const VU32 index = indexOf(task, hn::Floor(px.x), hn::Floor(px.y));
  hn::StoreU(hn::IfThenElse(hn::RebindMask(du, inside), index, nowhere), du, indices);
  hn::StoreU(key, I32(), keys);
}

// Samples over their footprints.
HWY_ATTR HWY_INLINE void spread(const ProjectTask &task, const Seen &seen, hn::Vec<I32> key, VU32 nowhere, VF half_x,
                                VF half_y, const ProjectedRow &out) {
  const F32 d;
  const U32 du;
  const I32 di;
  const VF far = hn::Set(d, kFarPx);
  const Extent x = extentOf(seen.px.x, half_x, task.grown, task.color.width);
  const Extent y = extentOf(seen.px.y, half_y, task.grown, task.color.height);
  const MF near = hn::And(hn::And(seen.valid, hn::Gt(half_x, hn::Zero(d))),
                          hn::And(hn::Lt(hn::Abs(seen.px.x), far), hn::Lt(hn::Abs(seen.px.y), far)));
  const MF inside = hn::And(near, hn::And(hn::Lt(x.first, x.last), hn::Lt(y.first, y.last)));
  const VF shape = hn::Add(hn::Mul(hn::Sub(y.last, y.first), hn::Set(d, 65536.0f)), hn::Sub(x.last, x.first));
  const VU32 whole_shape = hn::Sub(wholeBits(shape), hn::Set(du, kWholeBits));
  const VU32 index = indexOf(task, x.first, y.first);
  const auto inside_u = hn::RebindMask(du, inside);
  hn::StoreU(hn::IfThenElse(inside_u, index, nowhere), du, out.spread_index + out.count);
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
  const int32_t lanes = static_cast<int32_t>(hn::Lanes(d));
  const VU32 nowhere = hn::Iota(U32(), task.plane_rest);  // a place of its own for each lane
  out.count = 0;
  for (int32_t u = 0; u < in.count; u += lanes) {
    if (hn::AllTrue(d16, hn::Eq(hn::LoadU(d16, in.sensed + u), hn::Set(d16, kNotSensed)))) continue;
    const VF z = hn::Add(floatOf(in.sensed + u), hn::Set(d, 1.0f)), z2 = hn::Mul(z, z);
    const Seen seen = seenFrom<kModel>(task, in, u, z);
    const VF slope = hn::Min(floatOf(in.slope + u), hn::Mul(hn::Set(d, kSteepest), z));
    const VF slope2 = hn::Mul(slope, slope);
    const VF sigma = madd(hn::Set(d, task.sigma), task.sigma_per_raw2, z2), sigma2 = hn::Mul(sigma, sigma);
    const VF good2 = hn::Mul(hn::Set(d, kGoodError * kGoodError), z2);
    const auto key = keyOf(seen.subunits, good2, madd(sigma2, kPlacedPx * kPlacedPx, slope2));
    place(task, seen, key, nowhere, out.index + out.count, out.key + out.count);
    if (task.with_footprints) {
      const auto spread_key = keyOf(seen.subunits, good2, madd(sigma2, kSpreadPx * kSpreadPx, slope2));
      spread(task, seen, spread_key, nowhere, halfWidth(in.half_x + u), halfWidth(in.half_y + u), out);
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
