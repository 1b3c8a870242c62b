// Making rows; see score-inl.h for how it is compiled.
#if defined(SPHC_POSE_ROWS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SPHC_POSE_ROWS_INL_H
#undef SPHC_POSE_ROWS_INL_H
#else
#define SPHC_POSE_ROWS_INL_H
#endif

#include "runtime/stages/pose/score-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sphc {
namespace HWY_NAMESPACE {
namespace {  // every file that includes this has its own

void prepare(PoseRows *rows, const DepthCorrection &correction) {
  const PoseTag d;
  const V one = hn::Set(d, 1.0f), offset = hn::Set(d, correction.offset_m), slope = hn::Set(d, correction.slope);
  const V noise = hn::Set(d, correction.noise_scale);
  for (size_t at = 0; at < rows->padded; at += hn::Lanes(d)) {
    V3 point = load3(*rows, kPointX, at);
    const V sideways = hn::Load(d, rows->field[kWeight] + at),
            along = hn::Mul(noise, hn::Load(d, rows->field[kStretch] + at));
    // 0 without depth, and then there is nothing to correct; else not so small that the stretch rounds to -1
    const V known = hn::Div(sideways, along);
    const V ratio = hn::IfThenElseZero(hn::Gt(known, hn::Zero(d)), hn::Max(known, hn::Set(d, 1e-3f)));
    const V bias = hn::Add(offset, hn::Mul(slope, hn::Sub(point.z, hn::Set(d, correction.mid_m))));
    const V longer = hn::Add(one, hn::IfThenElseZero(hn::Gt(ratio, hn::Zero(d)), hn::Div(bias, point.z)));
    point = longer * point;
    const V3 seen = fromCentre(*rows, point, at);
    const V3 view = hn::Div(one, hn::Sqrt(dot(seen, seen))) * seen;
    const V *points[3] = {&point.x, &point.y, &point.z}, *views[3] = {&view.x, &view.y, &view.z};
    for (uint32_t k = 0; k < 3; ++k) {
      hn::Store(*points[k], d, rows->field[kPointX + k] + at);
      hn::Store(*views[k], d, rows->field[kViewX + k] + at);
    }
    hn::Store(hn::Div(one, hn::Mul(sideways, sideways)), d, rows->field[kWeight] + at);
    hn::Store(hn::Sub(hn::Mul(ratio, ratio), one), d, rows->field[kStretch] + at);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sphc
HWY_AFTER_NAMESPACE();
#endif
