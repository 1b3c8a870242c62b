// Minimal solvers for a whole batch of samples; see score-inl.h for how it is compiled.
#if defined(SPHC_POSE_MINIMAL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SPHC_POSE_MINIMAL_INL_H
#undef SPHC_POSE_MINIMAL_INL_H
#else
#define SPHC_POSE_MINIMAL_INL_H
#endif

#include "runtime/stages/pose/score-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sphc {
namespace HWY_NAMESPACE {
namespace {  // every file that includes this has its own

HWY_INLINE V set(float x) { return hn::Set(PoseTag(), x); }
HWY_INLINE V square(V x) { return hn::Mul(x, x); }
HWY_INLINE V3 loadSample(const float (*axes)[kMinimalBatch], size_t lane) {
  const PoseTag d;
  return {hn::Load(d, axes[0] + lane), hn::Load(d, axes[1] + lane), hn::Load(d, axes[2] + lane)};
}
HWY_INLINE V3 normalized(const V3 &a) { return hn::Div(set(1.0f), hn::Sqrt(dot(a, a))) * a; }
HWY_INLINE V3 select(hn::Mask<PoseTag> mask, const V3 &yes, const V3 &no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y), hn::IfThenElse(mask, yes.z, no.z)};
}
HWY_INLINE V3 longest(const V3 &a, const V3 &b, const V3 &c) {
  const V aa = dot(a, a), bb = dot(b, b), cc = dot(c, c);
  const V3 ab = select(hn::Gt(bb, aa), b, a);
  return select(hn::Gt(cc, hn::Max(aa, bb)), c, ab);
}

// Orthonormal axes of a triangle: along its first side, across it in the plane, and the plane's normal.
struct Axes {
  V3 x, y, z;
};
HWY_INLINE Axes axesOf(const V3 &side01, const V3 &side02) {
  Axes a;
  a.x = normalized(side01);
  a.z = normalized(cross(a.x, side02));
  a.y = cross(a.z, a.x);
  return a;
}

// to_from, row-major.
HWY_INLINE void rotationBetween(const Axes &to, const Axes &from, V *r) {
  const V to_x[3] = {to.x.x, to.x.y, to.x.z}, to_y[3] = {to.y.x, to.y.y, to.y.z};
  const V to_z[3] = {to.z.x, to.z.y, to.z.z};
  for (int i = 0; i < 3; ++i) {
    r[3 * i] = dot({to_x[i], to_y[i], to_z[i]}, {from.x.x, from.y.x, from.z.x});
    r[3 * i + 1] = dot({to_x[i], to_y[i], to_z[i]}, {from.x.y, from.y.y, from.z.y});
    r[3 * i + 2] = dot({to_x[i], to_y[i], to_z[i]}, {from.x.z, from.y.z, from.z.z});
  }
}

HWY_INLINE void storePose(PoseBatch *poses, uint32_t solution, size_t lane, const V *r, const V3 &t,
                          hn::Mask<PoseTag> valid) {
  const PoseTag d;
  for (int i = 0; i < 9; ++i) hn::Store(r[i], d, poses->r[solution][i] + lane);
  hn::Store(t.x, d, poses->t[solution][0] + lane);
  hn::Store(t.y, d, poses->t[solution][1] + lane);
  hn::Store(t.z, d, poses->t[solution][2] + lane);
  hn::Store(hn::IfThenElseZero(valid, set(1.0f)), d, poses->valid[solution] + lane);
}

// Triangles of the sample: sides as squared lengths in units of their sum, cosines between the map directions.
struct TriangleV {
  V c01, c02, c12, d01, d02, d12;
};

// One real root of k3 x^3 + k2 x^2 + k1 x + k0: Newton from beyond the extrema, where the cubic is steep.
HWY_INLINE V cubicRoot(V k3, V k2, V k1, V k0) {
  const V b = hn::Div(k2, k3), c = hn::Div(k1, k3), e = hn::Div(k0, k3);
  const V inflection = hn::Mul(set(-1.0f / 3), b);
  const V value = hn::Add(hn::Mul(hn::Add(hn::Mul(hn::Add(inflection, b), inflection), c), inflection), e);
  const V spread2 = hn::Sub(square(b), hn::Mul(set(3.0f), c));
  // Both bounds are beyond the root: twice the distance of the extrema, and |value|^(1/3) <= |value|^(1/2 or 1/4).
  const V far = hn::Mul(set(2.0f / 3), hn::Sqrt(hn::Max(spread2, hn::Zero(PoseTag()))));
  const V half = hn::Sqrt(hn::Abs(value));
  const V reach = hn::Max(far, hn::Max(half, hn::Sqrt(half)));
  V x = hn::Add(inflection, hn::CopySign(reach, hn::Neg(value)));
  for (int i = 0; i < 8; ++i) {
    const V f = hn::Add(hn::Mul(hn::Add(hn::Mul(hn::Add(x, b), x), c), x), e);
    const V slope = hn::Add(hn::Mul(hn::Add(hn::Mul(set(3.0f), x), hn::Add(b, b)), x), c);
    x = hn::Sub(x, hn::Div(f, slope));
  }
  return x;
}

// The line pair l m^T + m l^T that a member of the pencil of two cones degenerates to (see p3p.h).
HWY_INLINE void degenerateLines(const TriangleV &t, V3 *first, V3 *second) {
  // A = law01 d12 - law12 d01 and B = law02 d12 - law12 d02; A02 = B01 = 0
  const V a00 = t.d12, a11 = hn::Sub(t.d12, t.d01), a22 = hn::Neg(t.d01);
  const V a01 = hn::Neg(hn::Mul(t.c01, t.d12)), a12 = hn::Mul(t.c12, t.d01);
  const V b00 = t.d12, b11 = hn::Neg(t.d02), b22 = hn::Sub(t.d12, t.d02);
  const V b02 = hn::Neg(hn::Mul(t.c02, t.d12)), b12 = hn::Mul(t.c12, t.d02);
  // adjugates, for det(A + x B) = k3 x^3 + k2 x^2 + k1 x + k0
  const V a_adj00 = hn::Sub(hn::Mul(a11, a22), square(a12)), a_adj01 = hn::Neg(hn::Mul(a01, a22));
  const V a_adj02 = hn::Mul(a01, a12), a_adj11 = hn::Mul(a00, a22);
  const V a_adj12 = hn::Neg(hn::Mul(a00, a12)), a_adj22 = hn::Sub(hn::Mul(a00, a11), square(a01));
  const V b_adj00 = hn::Sub(hn::Mul(b11, b22), square(b12)), b_adj01 = hn::Mul(b02, b12);
  const V b_adj02 = hn::Neg(hn::Mul(b02, b11)), b_adj11 = hn::Sub(hn::Mul(b00, b22), square(b02));
  const V b_adj12 = hn::Neg(hn::Mul(b00, b12)), b_adj22 = hn::Mul(b00, b11);
  const V two = set(2.0f);
  const V k0 = hn::Add(hn::Mul(a00, a_adj00), hn::Mul(a01, a_adj01));
  const V k3 = hn::Add(hn::Mul(b00, b_adj00), hn::Mul(b02, b_adj02));
  const V k1 =
      hn::Add(hn::Add(hn::Mul(b00, a_adj00), hn::Mul(b11, a_adj11)),
              hn::Add(hn::Mul(b22, a_adj22), hn::Mul(two, hn::Add(hn::Mul(b02, a_adj02), hn::Mul(b12, a_adj12)))));
  const V k2 =
      hn::Add(hn::Add(hn::Mul(a00, b_adj00), hn::Mul(a11, b_adj11)),
              hn::Add(hn::Mul(a22, b_adj22), hn::Mul(two, hn::Add(hn::Mul(a01, b_adj01), hn::Mul(a12, b_adj12)))));
  const auto swap = hn::Gt(hn::Abs(k0), hn::Abs(k3));  // divide by the larger end, so that the root stays in reach
  const V x = cubicRoot(hn::IfThenElse(swap, k0, k3), hn::IfThenElse(swap, k1, k2), hn::IfThenElse(swap, k2, k1),
                        hn::IfThenElse(swap, k3, k0));
  const V wa = hn::IfThenElse(swap, x, set(1.0f)), wb = hn::IfThenElse(swap, set(1.0f), x);
  const V e00 = hn::Add(hn::Mul(wa, a00), hn::Mul(wb, b00)), e11 = hn::Add(hn::Mul(wa, a11), hn::Mul(wb, b11));
  const V e22 = hn::Add(hn::Mul(wa, a22), hn::Mul(wb, b22)), e12 = hn::Add(hn::Mul(wa, a12), hn::Mul(wb, b12));
  const V e01 = hn::Mul(wa, a01), e02 = hn::Mul(wb, b02);
  // minus the adjugate is p p^T with p = l x m, where the lines are real
  const V m00 = hn::Sub(square(e12), hn::Mul(e11, e22)), m11 = hn::Sub(square(e02), hn::Mul(e00, e22));
  const V m22 = hn::Sub(square(e01), hn::Mul(e00, e11)), m01 = hn::Sub(hn::Mul(e01, e22), hn::Mul(e02, e12));
  const V m02 = hn::Sub(hn::Mul(e02, e11), hn::Mul(e01, e12)), m12 = hn::Sub(hn::Mul(e00, e12), hn::Mul(e01, e02));
  const auto is1 = hn::Gt(m11, m00);
  const V m01_best = hn::Max(m00, m11);
  const auto is2 = hn::Gt(m22, m01_best);
  V3 p = select(is2, {m02, m12, m22}, select(is1, {m01, m11, m12}, {m00, m01, m02}));
  p = hn::Div(set(1.0f), hn::Sqrt(hn::Max(m22, m01_best))) * p;
  const V n01 = hn::Sub(e01, p.z), n02 = hn::Add(e02, p.y), n12 = hn::Sub(e12, p.x);
  const V n10 = hn::Add(e01, p.z), n20 = hn::Sub(e02, p.y), n21 = hn::Add(e12, p.x);
  *first = longest({e00, n01, n02}, {n10, e11, n12}, {n20, n21, e22});
  *second = longest({e00, n10, n20}, {n01, e11, n21}, {n02, n12, e22});
}

// Newton on the three laws of cosines.  Returns the largest error that is left.
HWY_INLINE V polishDepths(const TriangleV &t, V3 *depth) {
  V worst = set(0.0f);
  for (int i = 0; i < 3; ++i) {
    const V x = depth->x, y = depth->y, z = depth->z;
    const V cx_y = hn::Sub(x, hn::Mul(t.c01, y)), cy_x = hn::Sub(y, hn::Mul(t.c01, x));
    const V cx_z = hn::Sub(x, hn::Mul(t.c02, z)), cz_x = hn::Sub(z, hn::Mul(t.c02, x));
    const V cy_z = hn::Sub(y, hn::Mul(t.c12, z)), cz_y = hn::Sub(z, hn::Mul(t.c12, y));
    const V e01 = hn::Sub(hn::Add(hn::Mul(x, cx_y), hn::Mul(y, cy_x)), t.d01);
    const V e02 = hn::Sub(hn::Add(hn::Mul(x, cx_z), hn::Mul(z, cz_x)), t.d02);
    const V e12 = hn::Sub(hn::Add(hn::Mul(y, cy_z), hn::Mul(z, cz_y)), t.d12);
    worst = hn::Max(hn::Abs(e01), hn::Max(hn::Abs(e02), hn::Abs(e12)));
    if (i == 2) break;
    // half the Jacobian: (cx_y cy_x 0; cx_z 0 cz_x; 0 cy_z cz_y), solved by Cramer's rule
    const V dc = hn::Mul(cz_x, cy_z), bf = hn::Mul(cy_x, cz_y), ce = hn::Mul(cx_z, cy_z);
    const V scale = hn::Div(set(0.5f), hn::Add(hn::Mul(cx_y, dc), hn::Mul(cx_z, bf)));
    const V u = hn::Sub(hn::Mul(hn::Mul(cy_x, cz_x), e12), hn::Add(hn::Mul(e01, dc), hn::Mul(bf, e02)));
    const V v =
        hn::Sub(hn::Mul(cx_y, hn::Sub(hn::Mul(e02, cz_y), hn::Mul(cz_x, e12))), hn::Mul(e01, hn::Mul(cx_z, cz_y)));
    const V w =
        hn::Sub(hn::Mul(e01, ce), hn::Add(hn::Mul(cx_y, hn::Mul(e02, cy_z)), hn::Mul(cy_x, hn::Mul(cx_z, e12))));
    depth->x = hn::Add(x, hn::Mul(u, scale));
    depth->y = hn::Add(y, hn::Mul(v, scale));
    depth->z = hn::Add(z, hn::Mul(w, scale));
  }
  return worst;
}

void solveP3pBatch(const MinimalBatch &batch, PoseBatch *poses) {
  const PoseTag d;
  for (size_t lane = 0; lane < kMinimalBatch; lane += hn::Lanes(d)) {
    V3 point[3], direction[3];
    for (int k = 0; k < 3; ++k) {
      point[k] = loadSample(batch.point_m[k], lane);
      direction[k] = loadSample(batch.direction[k], lane);
    }
    const V3 p01 = point[1] - point[0], p02 = point[2] - point[0], p12 = point[2] - point[1];
    TriangleV t = {dot(direction[0], direction[1]),
                   dot(direction[0], direction[2]),
                   dot(direction[1], direction[2]),
                   dot(p01, p01),
                   dot(p02, p02),
                   dot(p12, p12)};
    const V sum = hn::Add(hn::Add(t.d01, t.d02), t.d12), inverse = hn::Div(set(1.0f), sum);
    t.d01 = hn::Mul(t.d01, inverse);
    t.d02 = hn::Mul(t.d02, inverse);
    t.d12 = hn::Mul(t.d12, inverse);
    const V metres = hn::Sqrt(sum);
    const Axes camera = axesOf(p01, p02);
    V3 lines[2];
    degenerateLines(t, &lines[0], &lines[1]);
    for (uint32_t s = 0; s < kMaxSolutions; ++s) {
      // depth_0 = w1 depth_1 + w2 depth_2, then a quadratic in ratio = depth_2 / depth_1
      const V3 line = lines[s / 2];
      const V scale = hn::Div(set(-1.0f), line.x), w1 = hn::Mul(line.y, scale), w2 = hn::Mul(line.z, scale);
      const V a = hn::Sub(hn::Mul(t.d12, square(w2)), t.d01);
      const V half_b = hn::Add(hn::Mul(t.c12, t.d01), hn::Mul(hn::Mul(t.d12, w2), hn::Sub(w1, t.c01)));
      const V c =
          hn::Sub(hn::Mul(t.d12, hn::Add(set(1.0f), hn::Mul(w1, hn::Sub(w1, hn::Add(t.c01, t.c01))))), t.d01);
      const V discriminant = hn::Sub(square(half_b), hn::Mul(a, c));
      const V root = hn::Sqrt(hn::Max(discriminant, hn::Zero(d)));
      const V q = hn::Neg(hn::Add(half_b, hn::CopySign(root, half_b)));
      const V ratio = s % 2 == 0 ? hn::Div(q, a) : hn::Div(c, q);
      V3 depth;
      depth.y = hn::Sqrt(hn::Div(t.d12, hn::Add(set(1.0f), hn::Mul(ratio, hn::Sub(ratio, hn::Add(t.c12, t.c12))))));
      depth.z = hn::Mul(ratio, depth.y);
      depth.x = hn::Add(hn::Mul(w1, depth.y), hn::Mul(w2, depth.z));
      const V worst = polishDepths(t, &depth);
      const auto positive = hn::Gt(hn::Min(depth.x, hn::Min(depth.y, depth.z)), hn::Zero(d));
      const auto solved = hn::And(hn::And(positive, hn::Lt(worst, set(1e-3f))),
                                  hn::Ge(discriminant, hn::Mul(set(-1e-4f), square(half_b))));
      const V3 x0 = hn::Mul(metres, depth.x) * direction[0];
      const Axes map =
          axesOf(hn::Mul(metres, depth.y) * direction[1] - x0, hn::Mul(metres, depth.z) * direction[2] - x0);
      V r[9];
      rotationBetween(camera, map, r);
      // points on a line have no axes
      const V trace = hn::Add(hn::Add(r[0], r[4]), r[8]);
      const auto valid = hn::And(solved, hn::Lt(hn::Abs(trace), set(4.0f)));
      const V3 rotated = {dot({r[0], r[1], r[2]}, x0), dot({r[3], r[4], r[5]}, x0), dot({r[6], r[7], r[8]}, x0)};
      storePose(poses, s, lane, r, point[0] - rotated, valid);
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sphc
HWY_AFTER_NAMESPACE();
#endif
