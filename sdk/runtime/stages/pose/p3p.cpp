#include "runtime/stages/pose/p3p.h"

#include <Eigen/LU>

namespace sphc {
namespace {

// The three unknown depths satisfy depth^T M_ij depth = d_ij^2: the law of cosines in triangle (origin, i, j).
struct Triangle {
  double cosine[3];     // between bearings 12, 13, 23
  double distance2[3];  // between points 12, 13, 23
};
constexpr int kFirst[3] = {0, 0, 1}, kSecond[3] = {1, 2, 2};

Matrix3 lawOfCosines(const Triangle &triangle, int pair) {
  Matrix3 m = Matrix3::Zero();
  const int i = kFirst[pair], j = kSecond[pair];
  m(i, i) = m(j, j) = 1;
  m(i, j) = m(j, i) = -triangle.cosine[pair];
  return m;
}

// One real root of x^3 + b x^2 + c x + d, where the cubic is steepest: Newton from beyond its extrema.
double realCubicRoot(double b, double c, double d) {
  const double inflection = -b / 3;
  const double spread2 = b * b - 3 * c;  // (distance of the extrema from the inflection)^2 * 9
  double x = inflection;
  if (spread2 > 0) {
    const double value = ((inflection + b) * inflection + c) * inflection + d;
    const double reach = 2 * sqrtOf(spread2) / 3;  // beyond the far root of a cubic with three
    x += value > 0 ? -reach : reach;
  }
  for (int i = 0; i < 60; ++i) {
    const double value = ((x + b) * x + c) * x + d, slope = (3 * x + 2 * b) * x + c;
    if (slope == 0) {
      x += 1e-3;
      continue;
    }
    const double step = value / slope;
    x -= step;
    if (absOf(step) <= 1e-14 * (1 + absOf(x))) break;
  }
  return x;
}

// gamma with det(a + gamma b) = 0.
bool degenerateMember(const Matrix3 &a, const Matrix3 &b, Matrix3 *degenerate) {
  const auto det3 = [](const Vector3 &x, const Vector3 &y, const Vector3 &z) { return x.dot(y.cross(z)); };
  const Vector3 a0 = a.col(0), a1 = a.col(1), a2 = a.col(2), b0 = b.col(0), b1 = b.col(1), b2 = b.col(2);
  const double c3 = det3(b0, b1, b2), c0 = det3(a0, a1, a2);
  const double c2 = det3(a0, b1, b2) + det3(b0, a1, b2) + det3(b0, b1, a2);
  const double c1 = det3(b0, a1, a2) + det3(a0, b1, a2) + det3(a0, a1, b2);
  // Divide by the larger end, so that the root stays in reach.
  if (absOf(c3) >= absOf(c0)) {
    if (!(absOf(c3) > 0)) return false;
    *degenerate = a + realCubicRoot(c2 / c3, c1 / c3, c0 / c3) * b;
  } else {
    *degenerate = realCubicRoot(c1 / c0, c2 / c0, c3 / c0) * a + b;
  }
  return true;
}

// A degenerate conic l m^T + m l^T as its two lines.
bool splitConic(const Matrix3 &conic, Vector3 lines[2]) {
  // minus the adjugate is p p^T with p = l x m, where the lines are real
  Matrix3 minus_adjugate;
  minus_adjugate.col(0) = -conic.col(1).cross(conic.col(2));
  minus_adjugate.col(1) = -conic.col(2).cross(conic.col(0));
  minus_adjugate.col(2) = -conic.col(0).cross(conic.col(1));
  int k = 0;
  for (int i = 1; i < 3; ++i)
    if (minus_adjugate(i, i) > minus_adjugate(k, k)) k = i;
  if (!(minus_adjugate(k, k) > 0)) return false;
  const Vector3 p = minus_adjugate.col(k) / sqrtOf(minus_adjugate(k, k));
  const Matrix3 rank_one = conic + crossMatrix(p);
  int row = 0, column = 0;
  rank_one.cwiseAbs().maxCoeff(&row, &column);
  lines[0] = rank_one.row(row).transpose();
  lines[1] = rank_one.col(column);
  return true;
}

// Newton on the three laws of cosines.
Vector3 polishDepths(const Triangle &t, Vector3 depth) {
  for (int iteration = 0; iteration < 3; ++iteration) {
    Matrix3 jacobian = Matrix3::Zero();
    Vector3 error;
    for (int pair = 0; pair < 3; ++pair) {
      const int i = kFirst[pair], j = kSecond[pair];
      const double c = t.cosine[pair];
      error[pair] = depth[i] * depth[i] + depth[j] * depth[j] - 2 * c * depth[i] * depth[j] - t.distance2[pair];
      jacobian(pair, i) = 2 * (depth[i] - c * depth[j]);
      jacobian(pair, j) = 2 * (depth[j] - c * depth[i]);
    }
    const double det = jacobian.determinant();
    if (!(absOf(det) > 1e-18)) break;
    const Vector3 step = jacobian.inverse() * error;
    depth -= step;
    if (step.squaredNorm() < 1e-24) break;
  }
  return depth;
}

// The rotation and translation that carry three points onto three others; exact when the triangles are congruent.
Rigid alignTriangles(const Vector3 from[3], const Vector3 to[3]) {
  const auto basis = [](const Vector3 p[3]) {
    Matrix3 m;
    m.col(0) = (p[1] - p[0]).normalized();
    m.col(2) = m.col(0).cross(p[2] - p[0]).normalized();
    m.col(1) = m.col(2).cross(m.col(0));
    return m;
  };
  Rigid to_from;
  to_from.rotation = basis(to) * basis(from).transpose();
  to_from.translation_m = to[0] - to_from.rotation * from[0];
  return to_from;
}

// Depths where the plane line . depth = 0 meets the cone depth^T cone depth = 0.
void depthsOnLine(const Triangle &t, const Vector3 &line, const Matrix3 &cone, FixedVector<Vector3, 4> *depths) {
  int k = 0;
  for (int i = 1; i < 3; ++i)
    if (absOf(line[i]) > absOf(line[k])) k = i;
  if (!(absOf(line[k]) > 0)) return;
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  // depth_k = wi depth_i + wj depth_j, then a quadratic in ratio = depth_j / depth_i
  const double wi = -line[i] / line[k], wj = -line[j] / line[k];
  const double a = cone(j, j) + 2 * cone(j, k) * wj + cone(k, k) * wj * wj;
  const double b = 2 * (cone(i, j) + cone(i, k) * wj + cone(j, k) * wi + cone(k, k) * wi * wj);
  const double c = cone(i, i) + 2 * cone(i, k) * wi + cone(k, k) * wi * wi;
  double discriminant = b * b - 4 * a * c;
  if (!(discriminant > -1e-9 * b * b)) return;
  discriminant = discriminant > 0 ? sqrtOf(discriminant) : 0;
  const double q = -0.5 * (b + (b < 0 ? -discriminant : discriminant));
  const double ratios[2] = {q / a, c / q};
  for (double ratio : ratios) {
    if (!(ratio > 0) || !isFinite(ratio) || depths->full()) continue;
    Vector3 depth;
    depth[i] = 1;
    depth[j] = ratio;
    depth[k] = wi + wj * ratio;
    if (!(depth[k] > 0)) continue;
    // the scale from the longest side
    int pair = 0;
    for (int p = 1; p < 3; ++p)
      if (t.distance2[p] > t.distance2[pair]) pair = p;
    const double u = depth[kFirst[pair]], v = depth[kSecond[pair]];
    const double unit2 = u * u + v * v - 2 * t.cosine[pair] * u * v;
    if (!(unit2 > 0)) continue;
    depths->push(depth * sqrtOf(t.distance2[pair] / unit2));
  }
}

}  // namespace

FixedVector<Rigid, 4> solveP3p(const Vector3 bearing[3], const Vector3 point[3]) {
  FixedVector<Rigid, 4> poses;
  Triangle t;
  for (int pair = 0; pair < 3; ++pair) {
    const int i = kFirst[pair], j = kSecond[pair];
    t.cosine[pair] = bearing[i].dot(bearing[j]);
    t.distance2[pair] = (point[i] - point[j]).squaredNorm();
    if (!(t.distance2[pair] > 0)) return poses;
  }
  // Two cones without a constant: differences of the laws, each scaled by the other's side.
  const Matrix3 law12 = lawOfCosines(t, 0), law13 = lawOfCosines(t, 1), law23 = lawOfCosines(t, 2);
  const Matrix3 first = law12 * (t.distance2[2] / t.distance2[0]) - law23;
  const Matrix3 second = law13 * (t.distance2[2] / t.distance2[1]) - law23;
  Matrix3 degenerate;
  Vector3 lines[2];
  if (!degenerateMember(first, second, &degenerate) || !splitConic(degenerate, lines)) return poses;
  FixedVector<Vector3, 4> depths;
  for (const Vector3 &line : lines) depthsOnLine(t, line, first, &depths);
  for (const Vector3 &start : depths) {
    const Vector3 depth = polishDepths(t, start);
    if (!(depth.minCoeff() > 0)) continue;
    const Vector3 target[3] = {depth[0] * bearing[0], depth[1] * bearing[1], depth[2] * bearing[2]};
    const Rigid pose = alignTriangles(point, target);
    if (isFinite(pose.rotation.sum()) && isFinite(pose.translation_m.sum())) poses.push(pose);
  }
  return poses;
}

}  // namespace sphc
