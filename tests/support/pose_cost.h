// The cost of a pose and a depth bias in double precision and plain words, for derivatives by differences.
#pragma once
#include <Eigen/LU>

#include "runtime/stages/pose/refine.h"
#include "runtime/stages/pose/residual.h"

namespace sphc::test {

// (rotation, translation, depth offset, depth slope) from a pose and no bias.
struct PoseCost {
  Rigid camera_from_map;
  double mid_m = 0, scale2 = 8, gate2 = 512;

  double lossOf(double squared, bool in_front) const {
    return in_front && squared < gate2 ? squared / (1 + squared / scale2) : scale2;
  }
  Rigid moved(const Vector8 &step) const {
    const Matrix3 turn = rotationFromVector(step.head<3>());
    return {turn * camera_from_map.rotation, turn * camera_from_map.translation_m + step.segment<3>(3)};
  }
  double lifted(Correspondence c, const Vector8 &step) const {
    const double z = c.lifted.point_m.z(), longer = 1 + (step[6] + step[7] * (z - mid_m)) / z;
    c.lifted = {longer * c.lifted.point_m, longer * c.lifted.sideways_m, longer * c.lifted.along_m,
                c.lifted.centre_m};
    const Residual r = residualOf(c, moved(step));
    return lossOf(r.squared, r.in_front);
  }
  // Of the angle between the viewing ray and the plane of the sphere centre, the camera that sees it and the
  // direction.
  double plane(const Correspondence &c, const Vector8 &step) const {
    const Rigid pose = moved(step);
    const Vector3 centre_m = c.lifted.centre_m.cast<double>(), t = pose.translation_m - centre_m;
    const Vector3 view = c.lifted.view(), ray = pose.rotation * c.direction;
    const double sine = view.dot(t.cross(ray).normalized());
    const double sigma = c.lifted.sideways_m / (c.lifted.point_m - centre_m).norm();
    // depth * view = t + m * ray, as well as they can
    Eigen::Matrix<double, 3, 2> rays;
    rays << view, -ray;
    const Matrix2 normal = rays.transpose() * rays;
    const Vector2 lengths = normal.inverse() * (rays.transpose() * t);
    return lossOf(sine * sine / (sigma * sigma), lengths[0] > 0 && lengths[1] > 0);
  }
};

template <typename Cost>
Vector8 gradientOf(const Cost &cost) {
  constexpr double kStep = 1e-6;
  Vector8 out;
  for (int i = 0; i < 8; ++i)
    out[i] = (cost(kStep * Vector8::Unit(i)) - cost(-kStep * Vector8::Unit(i))) / (2 * kStep);
  return out;
}

template <typename Cost>
Matrix8 curvatureOf(const Cost &cost) {
  constexpr double kStep = 1e-5;
  Matrix8 out;
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) {
      const Vector8 a = kStep * Vector8::Unit(i), b = kStep * Vector8::Unit(j);
      out(i, j) = (cost(a + b) - cost(a - b) - cost(b - a) + cost(-a - b)) / (4 * kStep * kStep);
    }
  return out;
}

}  // namespace sphc::test
