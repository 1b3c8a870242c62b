#include "runtime/stages/pose/residual.h"

namespace sphc {

Residual residualOf(const Correspondence &c, const Rigid &camera_from_map) {
  const Vector3 view = c.lifted.view();
  const Vector3 ray = camera_from_map.rotation * c.direction;
  const Vector3 ray_whitened = whiten(c.lifted, view, ray);
  const Vector3 offset_whitened = whiten(c.lifted, view, c.lifted.point_m - camera_from_map.translation_m);
  const double m = ray_whitened.dot(offset_whitened) / ray_whitened.squaredNorm();
  Residual r;
  r.whitened = offset_whitened - m * ray_whitened;
  r.ray_whitened = ray_whitened.normalized();
  r.foot_m = camera_from_map.translation_m + m * ray;
  r.squared = r.whitened.squaredNorm();
  r.in_front = m > 0;
  return r;
}

Matrix3 acrossRay(const LiftedPoint &lifted, const Residual &r) {
  const Vector3 view = lifted.view();
  Matrix3 whitening;
  for (int i = 0; i < 3; ++i) whitening.col(i) = whiten(lifted, view, Vector3::Unit(i));
  return whitening - r.ray_whitened * (r.ray_whitened.transpose() * whitening);
}

}  // namespace sphc
