// The minimal solver for a known vertical; see score-inl.h for how it is compiled.
#if defined(SPHC_POSE_UPRIGHT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SPHC_POSE_UPRIGHT_INL_H
#undef SPHC_POSE_UPRIGHT_INL_H
#else
#define SPHC_POSE_UPRIGHT_INL_H
#endif

#include "runtime/stages/pose/minimal-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sphc {
namespace HWY_NAMESPACE {
namespace {  // every file that includes this has its own

struct Matrix3V {
  V3 row[3];
};
HWY_INLINE Matrix3V broadcast3(const float *m) {
  return {
      {{set(m[0]), set(m[1]), set(m[2])}, {set(m[3]), set(m[4]), set(m[5])}, {set(m[6]), set(m[7]), set(m[8])}}};
}
HWY_INLINE V3 operator*(const Matrix3V &m, const V3 &a) {
  return {dot(m.row[0], a), dot(m.row[1], a), dot(m.row[2], a)};
}

// In upright frames p = Rz(yaw) depth d + t.  The difference of two such equations has a vertical part, linear in
// the depths, and a length, quadratic in them; then the yaw follows from its horizontal part.
void solveUprightBatch(const MinimalBatch &batch, const UprightFrames &frames, PoseBatch *poses) {
  const PoseTag d;
  const V zero = hn::Zero(d), one = set(1.0f);
  const Matrix3V from_map = broadcast3(frames.upright_from_map),
                 from_camera = broadcast3(frames.upright_from_camera);
  for (size_t lane = 0; lane < kMinimalBatch; lane += hn::Lanes(d)) {
    const V3 point0 = loadSample(batch.point_m[0], lane), point1 = loadSample(batch.point_m[1], lane);
    const V3 given0 = loadSample(batch.direction[0], lane), given1 = loadSample(batch.direction[1], lane);
    const V3 first = from_map * given0, second = from_map * given1, side = from_camera * (point1 - point0);
    const auto swap = hn::Gt(hn::Abs(first.z), hn::Abs(second.z));  // `high` is the one to divide by
    const V3 low = select(swap, second, first), high = select(swap, first, second);
    const V3 reach = select(swap, set(-1.0f) * side, side);  // from low to high
    // depth_high = h + g depth_low
    const V g = hn::Div(low.z, high.z), h = hn::Div(reach.z, high.z), cosine = dot(low, high);
    const V a = hn::Add(one, hn::Mul(g, hn::Sub(g, hn::Add(cosine, cosine))));
    const V half_b = hn::Mul(h, hn::Sub(g, cosine)), c = hn::Sub(square(h), dot(reach, reach));
    const V discriminant = hn::Sub(square(half_b), hn::Mul(a, c));
    const V root = hn::Sqrt(hn::Max(discriminant, zero));
    for (uint32_t s = 0; s < kMaxSolutions; ++s) {
      if (s >= 2) {
        hn::Store(zero, d, poses->valid[s] + lane);
        continue;
      }
      const V depth_low = hn::Div(hn::Sub(s == 0 ? root : hn::Neg(root), half_b), a);
      const V depth_high = hn::Add(h, hn::Mul(g, depth_low));
      const V3 across = depth_high * high - depth_low * low;
      const V length2 =
          hn::Mul(hn::Add(square(across.x), square(across.y)), hn::Add(square(reach.x), square(reach.y)));
      const V inverse = hn::Div(one, hn::Sqrt(length2));
      const V cos_yaw = hn::Mul(inverse, hn::Add(hn::Mul(across.x, reach.x), hn::Mul(across.y, reach.y)));
      const V sin_yaw = hn::Mul(inverse, hn::Sub(hn::Mul(across.x, reach.y), hn::Mul(across.y, reach.x)));
      // camera_from_map = upright_from_camera^T Rz(yaw) upright_from_map
      const V3 x = cos_yaw * from_map.row[0] - sin_yaw * from_map.row[1];
      const V3 y = sin_yaw * from_map.row[0] + cos_yaw * from_map.row[1];
      V r[9];
      rotationBetween({from_camera.row[0], from_camera.row[1], from_camera.row[2]}, {x, y, from_map.row[2]}, r);
      const V depth0 = hn::IfThenElse(swap, depth_high, depth_low);
      const V3 x0 = depth0 * given0;
      const V3 rotated = {dot({r[0], r[1], r[2]}, x0), dot({r[3], r[4], r[5]}, x0), dot({r[6], r[7], r[8]}, x0)};
      const auto valid = hn::And(hn::And(hn::Gt(hn::Min(depth_low, depth_high), zero), hn::Ge(discriminant, zero)),
                                 hn::Gt(length2, set(1e-8f)));
      storePose(poses, s, lane, r, point0 - rotated, valid);
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sphc
HWY_AFTER_NAMESPACE();
#endif
