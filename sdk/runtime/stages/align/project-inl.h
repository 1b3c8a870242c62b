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
using VF = hn::Vec<F32>;

constexpr float kEdgeJump = 0.03f;      // relative depth step between neighbours that is an edge
constexpr float kSteepest = 0.1f;       // relative depth step beyond which a neighbour says nothing more
constexpr float kGoodError = 0.01f;     // relative depth error of confidence 127
constexpr float kPlacedPx = 0.3f;       // 1 sigma of where in its pixel a sample was measured
constexpr float kSpreadPx = 0.8f;       // the same beside its pixel
constexpr float kFarPx = 1e6f;          // a pixel of numbers that are too large, or not numbers
constexpr float kLeastShadowPx = 0.5f;  // narrower ones are within the error of the edge

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

// Largest depth difference from a neighbour; of no measurement and of another surface the steepest.
HWY_ATTR HWY_INLINE VF slopeOf(VF z, VF left, VF right, VF above, VF below) {
  const VF across = hn::Max(hn::Abs(hn::Sub(z, left)), hn::Abs(hn::Sub(z, right)));
  const VF down = hn::Max(hn::Abs(hn::Sub(z, above)), hn::Abs(hn::Sub(z, below)));
  return hn::Min(hn::Max(across, down), hn::Mul(hn::Set(F32(), kSteepest), z));
}

// 255 for an exact depth, 127 for a relative error of kGoodError: 255 / (1 + (error / good)^2).
HWY_ATTR HWY_INLINE VF confidenceOf(VF good2, VF sigma2, VF slope, float placed_px) {
  const F32 d;
  const VF misplaced = hn::Mul(hn::Set(d, placed_px), slope);
  const VF all = hn::Add(hn::Add(good2, sigma2), hn::Mul(misplaced, misplaced));
  return hn::Div(hn::Mul(hn::Set(d, 255.0f), good2), all);
}

HWY_ATTR HWY_INLINE hn::Vec<I32> keyOf(hn::Vec<I32> depth, VF confidence) {
  const I32 di;
  const auto doubt = hn::Sub(hn::Set(di, 255), hn::ConvertTo(di, hn::Add(confidence, hn::Set(F32(), 0.5f))));
  return hn::Or(hn::ShiftLeft<kDepthShift>(depth), doubt);
}

HWY_ATTR HWY_INLINE VF halfWidth(const uint8_t *table) {
  const hn::Rebind<uint8_t, F32> bytes;
  const VF sixteenths = hn::ConvertTo(F32(), hn::PromoteTo(I32(), hn::LoadU(bytes, table)));
  return hn::Mul(sixteenths, hn::Set(F32(), 1 / kFootprintsPerPixel));
}

// First pixel whose centre is not before `edge`, within [0, most].
HWY_ATTR HWY_INLINE hn::Vec<I32> firstFrom(VF edge, float most) {
  const F32 d;
  const VF first = hn::Ceil(hn::Sub(edge, hn::Set(d, 0.5f)));
  return hn::ConvertTo(I32(), hn::Min(hn::Max(first, hn::Zero(d)), hn::Set(d, most)));
}

// `toward`: how far to the colour camera along one axis of the image; `other`: along the other.  Is the neighbour
// on that side missing, or clearly farther, and would the gap show?
HWY_ATTR HWY_INLINE hn::Mask<F32> opensGap(const ProjectTask &task, VF z, VF toward, VF other, VF before,
                                           VF after) {
  const F32 d;
  const VF zero = hn::Zero(d), neighbour = hn::IfThenElse(hn::Gt(toward, zero), after, before);
  const auto edge = hn::Or(hn::Eq(neighbour, zero), hn::Gt(neighbour, hn::Mul(z, hn::Set(d, 1 + kEdgeJump))));
  const VF reach = hn::Abs(toward), parallax = hn::Mul(hn::Set(d, task.depth_focal_px), reach);
  const VF least = hn::Max(hn::Mul(hn::Set(d, kLeastShadowPx), z),
                           hn::Mul(hn::Set(d, kObliquest * task.depth_focal_px), hn::Abs(other)));
  return hn::And(edge, hn::Gt(parallax, least));
}

// Depths of a vector of pixels and of their neighbours.
struct Neighbours {
  VF z, left, right, above, below;
};

// Appends those of `steep` pixels behind which the colour camera may see what the depth camera cannot.
HWY_ATTR HWY_INLINE void findEdges(const ProjectTask &task, const Neighbours &n, const Point2 &ray,
                                   hn::Mask<F32> steep, int32_t u, ProjectedRow *out) {
  const F32 d;
  const float *c = task.center_m;
  const VF toward_x = hn::Sub(hn::Set(d, c[0]), hn::Mul(hn::Set(d, c[2]), ray.x));
  const VF toward_y = hn::Sub(hn::Set(d, c[1]), hn::Mul(hn::Set(d, c[2]), ray.y));
  const auto edge = hn::And(steep, hn::Or(opensGap(task, n.z, toward_x, toward_y, n.left, n.right),
                                          opensGap(task, n.z, toward_y, toward_x, n.above, n.below)));
  uint8_t bits[kRowPadding / 8 < 8 ? 8 : kRowPadding / 8] = {};
  const size_t bytes = hn::StoreMaskBits(d, edge, bits);
  for (size_t byte = 0; byte < bytes; ++byte)
    for (int32_t bit = 0; bits[byte] >> bit; ++bit)
      if (bits[byte] >> bit & 1) out->edges[out->edge_count++] = u + static_cast<int32_t>(8 * byte) + bit;
}

// What a vector of pixels without measurements gives.
HWY_ATTR HWY_INLINE void storeNothing(const ProjectTask &task, const ProjectedRow &out, int32_t u) {
  const I32 d;
  hn::StoreU(hn::Zero(d), d, out.index + u);
  hn::StoreU(hn::Set(d, kEmpty), d, out.key + u);
  if (!task.with_footprints) return;
  hn::StoreU(hn::Zero(d), d, out.right + u);
  hn::StoreU(hn::Zero(d), d, out.left + u);
}

template <sphc_camera_model kModel>
HWY_ATTR void projectRowOf(const ProjectTask &task, const SensedRows &in, ProjectedRow *out) {
  const F32 d;
  const I32 di;
  const VF zero = hn::Zero(d);
  const int32_t lanes = static_cast<int32_t>(hn::Lanes(d));
  const float *r = task.r;
  out->edge_count = 0;
  for (int32_t u = 0; u < in.count; u += lanes) {
    const VF z = hn::LoadU(d, in.here + u);
    if (hn::AllFalse(d, hn::Gt(z, zero))) {
      storeNothing(task, *out, u);
      continue;
    }
    const VF left = hn::LoadU(d, in.here + u - 1), right = hn::LoadU(d, in.here + u + 1);
    const VF above = hn::LoadU(d, in.above + u), below = hn::LoadU(d, in.below + u);
    const VF x = hn::LoadU(d, in.ray_x + u), y = hn::LoadU(d, in.ray_y + u);

    const auto turned = [&](int row)
                            HWY_ATTR { return madd(madd(hn::Set(d, r[row + 2]), r[row + 1], y), r[row], x); };
    const VF color_x = hn::Add(hn::Mul(z, turned(0)), hn::Set(d, task.t[0]));
    const VF color_y = hn::Add(hn::Mul(z, turned(3)), hn::Set(d, task.t[1]));
    const VF color_z = hn::Add(hn::Mul(z, turned(6)), hn::Set(d, task.t[2]));
    const VF inverse = hn::Div(hn::Set(d, 1.0f), color_z);
    const Point2 ray = {hn::Mul(color_x, inverse), hn::Mul(color_y, inverse)};
    const VF r2 = hn::Add(hn::Mul(ray.x, ray.x), hn::Mul(ray.y, ray.y));
    const Point2 px = colorPixel<kModel>(task.color, ray, r2);
    const VF subunits = hn::Mul(color_z, hn::Set(d, task.subunits_per_m));
    const auto seen = hn::And(
        hn::And(hn::Gt(z, zero), hn::Le(r2, hn::Set(d, task.color.max_radius2))),
        hn::And(hn::Ge(subunits, hn::Set(d, 1.0f * kSubUnits)), hn::Le(subunits, hn::Set(d, task.most_subunits))));

    const VF slope = slopeOf(z, left, right, above, below);
    const VF sigma = madd(hn::Set(d, task.sigma_m), task.sigma_per_m2, hn::Mul(z, z)),
             sigma2 = hn::Mul(sigma, sigma);
    const VF good = hn::Mul(hn::Set(d, kGoodError), z), good2 = hn::Mul(good, good);
    const auto depth = hn::ConvertTo(di, hn::IfThenElseZero(seen, subunits));

    const auto inside =
        hn::And(hn::And(seen, hn::And(hn::Ge(px.x, zero), hn::Lt(px.x, hn::Set(d, task.color.width)))),
                hn::And(hn::Ge(px.y, zero), hn::Lt(px.y, hn::Set(d, task.color.height))));
    const auto column = hn::ConvertTo(di, hn::IfThenElseZero(inside, px.x));
    const auto row = hn::ConvertTo(di, hn::IfThenElseZero(inside, px.y));
    const auto index =
        hn::Add(hn::Add(column, hn::Mul(row, hn::Set(di, task.plane_stride))), hn::Set(di, task.plane_origin));
    const VF sure = hn::IfThenElseZero(seen, confidenceOf(good2, sigma2, slope, kPlacedPx));
    hn::StoreU(hn::IfThenElseZero(hn::RebindMask(di, inside), index), di, out->index + u);
    hn::StoreU(hn::IfThenElse(hn::RebindMask(di, inside), keyOf(depth, sure), hn::Set(di, kEmpty)), di,
               out->key + u);

    if (task.with_footprints) {
      const VF far = hn::Set(d, kFarPx);
      const auto near = hn::And(seen, hn::And(hn::Lt(hn::Abs(px.x), far), hn::Lt(hn::Abs(px.y), far)));
      const VF unsure = hn::IfThenElseZero(seen, confidenceOf(good2, sigma2, slope, kSpreadPx));
      const VF half_x = hn::IfThenElseZero(near, halfWidth(in.half_x + u));
      const VF half_y = hn::IfThenElseZero(near, halfWidth(in.half_y + u));
      const VF at_x = hn::IfThenElseZero(near, px.x), at_y = hn::IfThenElseZero(near, px.y);
      hn::StoreU(keyOf(depth, unsure), di, out->fill_key + u);
      hn::StoreU(firstFrom(hn::Sub(at_x, half_x), task.color.width), di, out->left + u);
      hn::StoreU(firstFrom(hn::Add(at_x, half_x), task.color.width), di, out->right + u);
      hn::StoreU(firstFrom(hn::Sub(at_y, half_y), task.color.height), di, out->top + u);
      hn::StoreU(firstFrom(hn::Add(at_y, half_y), task.color.height), di, out->bottom + u);
    }

    const auto steep = hn::And(seen, hn::Gt(slope, hn::Mul(hn::Set(d, kEdgeJump), z)));
    if (!hn::AllFalse(d, steep)) findEdges(task, {z, left, right, above, below}, {x, y}, steep, u, out);
  }
}

HWY_ATTR void projectRow(const ProjectTask &task, const SensedRows &in, ProjectedRow *out) {
  switch (task.color.model) {
    case SPHC_CAMERA_PINHOLE:
      return projectRowOf<SPHC_CAMERA_PINHOLE>(task, in, out);
    case SPHC_CAMERA_KANNALA_BRANDT4:
      return projectRowOf<SPHC_CAMERA_KANNALA_BRANDT4>(task, in, out);
    default:  // Brown 5 is Brown 8 with a constant denominator
      return projectRowOf<SPHC_CAMERA_BROWN8>(task, in, out);
  }
}

HWY_ATTR void senseRow(const uint16_t *raw, float unit_m, float low, float high, int32_t count, float *m) {
  const F32 d;
  const hn::Rebind<uint16_t, F32> d16;
  const int32_t lanes = static_cast<int32_t>(hn::Lanes(d));
  const auto sense = [&](hn::Vec<hn::Rebind<uint16_t, F32>> row) HWY_ATTR {
    const VF units = hn::ConvertTo(d, hn::PromoteTo(I32(), row));
    const auto good = hn::And(hn::Ge(units, hn::Set(d, low)), hn::Le(units, hn::Set(d, high)));
    return hn::IfThenElseZero(good, hn::Mul(units, hn::Set(d, unit_m)));
  };
  int32_t u = 0;
  for (; u + lanes <= count; u += lanes) hn::StoreU(sense(hn::LoadU(d16, raw + u)), d, m + u);
  if (u == count) return;
  uint16_t rest[kRowPadding] = {};
  for (int32_t i = u; i < count; ++i) rest[i - u] = raw[i];
  hn::StoreU(sense(hn::LoadU(d16, rest)), d, m + u);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sphc
HWY_AFTER_NAMESPACE();
#endif
