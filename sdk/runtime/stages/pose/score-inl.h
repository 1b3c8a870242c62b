// Scoring; compiled once for each instruction set by kernels_simd.cpp, and for single lanes by kernels_scalar.cpp.
#if defined(SPHC_POSE_SCORE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SPHC_POSE_SCORE_INL_H
#undef SPHC_POSE_SCORE_INL_H
#else
#define SPHC_POSE_SCORE_INL_H
#endif

#include <hwy/highway.h>

#include "runtime/stages/pose/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace sphc {
namespace HWY_NAMESPACE {
namespace {  // every file that includes this has its own
namespace hn = hwy::HWY_NAMESPACE;

using PoseTag = hn::CappedTag<float, kPoseLanes>;
using V = hn::Vec<PoseTag>;

struct V3 {
  V x, y, z;
};
HWY_INLINE V3 load3(const PoseRows &rows, uint32_t field, size_t at) {
  const PoseTag d;
  return {hn::Load(d, rows.field[field] + at), hn::Load(d, rows.field[field + 1] + at),
          hn::Load(d, rows.field[field + 2] + at)};
}
HWY_INLINE V3 operator+(const V3 &a, const V3 &b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE V3 operator-(const V3 &a, const V3 &b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE V3 operator*(V s, const V3 &a) { return {hn::Mul(s, a.x), hn::Mul(s, a.y), hn::Mul(s, a.z)}; }
HWY_INLINE V dot(const V3 &a, const V3 &b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
HWY_INLINE V3 cross(const V3 &a, const V3 &b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}
// A point as the camera that saw each row has it, but for its turn.
HWY_INLINE V3 fromCentre(const PoseRows &rows, const V3 &point, size_t at) {
  return rows.hasCentres() ? point - load3(rows, kCentreX, at) : point;
}

// A pose in every lane.
struct PoseV {
  V r[9];
  V3 t;
};
HWY_INLINE PoseV broadcast(const PoseF &pose) {
  const PoseTag d;
  PoseV out;
  for (int i = 0; i < 9; ++i) out.r[i] = hn::Set(d, pose.r[i]);
  out.t = {hn::Set(d, pose.t[0]), hn::Set(d, pose.t[1]), hn::Set(d, pose.t[2])};
  return out;
}
HWY_INLINE V3 rotate(const PoseV &pose, const V3 &x) {
  const V *r = pose.r;
  return {dot({r[0], r[1], r[2]}, x), dot({r[3], r[4], r[5]}, x), dot({r[6], r[7], r[8]}, x)};
}

// Sum of the lanes in an order of our own.
HWY_INLINE float sumOf(const float *lanes) {
  float eight[8], four[4];
  for (int i = 0; i < 8; ++i) eight[i] = lanes[i] + lanes[i + 8];
  for (int i = 0; i < 4; ++i) four[i] = eight[i] + eight[i + 4];
  return (four[0] + four[2]) + (four[1] + four[3]);
}

// See residual.h; the metric is W^2 = weight (I + stretch v v^T).
struct ResidualV {
  V3 ray;         // R d
  V3 offset;      // q = P - t - m n
  V view_offset;  // v . q
  V view_ray;     // v . n
  V metric_ray2;  // n^T W^2 n / weight
  V along;        // m
  V squared;      // q^T W^2 q
};
HWY_INLINE ResidualV residualOf(const PoseV &pose, const V3 &point, const V3 &view, const V3 &direction, V weight,
                                V stretch) {
  ResidualV o;
  o.ray = rotate(pose, direction);
  const V3 e = point - pose.t;
  const V vn = dot(view, o.ray), ve = dot(view, e);
  o.metric_ray2 = hn::Add(hn::Set(PoseTag(), 1.0f), hn::Mul(stretch, hn::Mul(vn, vn)));
  o.along = hn::Div(hn::Add(dot(e, o.ray), hn::Mul(stretch, hn::Mul(ve, vn))), o.metric_ray2);
  o.offset = e - o.along * o.ray;
  o.view_ray = vn;
  o.view_offset = hn::Sub(ve, hn::Mul(o.along, vn));
  const V sum = hn::Add(dot(o.offset, o.offset), hn::Mul(stretch, hn::Mul(o.view_offset, o.view_offset)));
  o.squared = hn::Mul(weight, hn::Max(hn::Zero(PoseTag()), sum));
  return o;
}
HWY_INLINE ResidualV residualAt(const PoseRows &rows, const PoseV &pose, size_t at) {
  const PoseTag d;
  return residualOf(pose, load3(rows, kPointX, at), load3(rows, kViewX, at), load3(rows, kDirectionX, at),
                    hn::Load(d, rows.field[kWeight] + at), hn::Load(d, rows.field[kStretch] + at));
}

Score score(const PoseRows &rows, const PoseF &pose, const ScoreLimits &limits) {
  const PoseTag d;
  const PoseV p = broadcast(pose);
  const V one = hn::Set(d, 1.0f), inverse = hn::Set(d, limits.inverse_threshold2);
  float total = 0.0f;
  for (size_t chunk = 0; chunk < rows.padded; chunk += kPoseChunk) {
    alignas(64) float lanes[kPoseLanes];
    for (size_t lane = 0; lane < kPoseLanes; lane += hn::Lanes(d)) {
      V sum = hn::Zero(d);
      for (size_t at = chunk + lane; at < chunk + kPoseChunk; at += kPoseLanes) {
        const ResidualV r = residualAt(rows, p, at);
        const V gain = hn::Max(hn::Zero(d), hn::Sub(one, hn::Mul(r.squared, inverse)));
        sum = hn::Add(sum, hn::IfThenElseZero(hn::Gt(r.along, hn::Zero(d)), gain));
      }
      hn::Store(sum, d, lanes + lane);
    }
    total += sumOf(lanes);
    const float seen = static_cast<float>(chunk + kPoseChunk), rest = static_cast<float>(rows.count) - seen;
    if (rest > 0 && (total + rest <= limits.best || total < limits.slope * seen - limits.offset))
      return {total, seen};
  }
  return {total, static_cast<float>(rows.count)};
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sphc
HWY_AFTER_NAMESPACE();
#endif
