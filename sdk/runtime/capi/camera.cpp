#include "runtime/geometry/camera.h"

#include "runtime/base/elementary.h"
#include "runtime/base/message.h"
#include "runtime/geometry/rigid.h"

using sphc::Camera;
using sphc::Vector2;
using sphc::Vector3;

sphc_status sphc_camera_check(const sphc_camera *camera, sphc_message *message) {
  if (!camera) {
    sphc::MessageWriter(message) << "camera is null; give one";
    return SPHC_E_ARGUMENT;
  }
  return sphc::checkCamera(*camera, "camera", message) ? SPHC_OK : SPHC_E_ARGUMENT;
}

sphc_status sphc_camera_project(const sphc_camera *camera, const double point_m[3], double pixel_px[2]) {
  if (!camera || !point_m || !pixel_px || !sphc::checkCamera(*camera, "camera", nullptr)) return SPHC_E_ARGUMENT;
  const Vector3 point(point_m[0], point_m[1], point_m[2]);
  Vector2 pixel;
  if (!point.allFinite()) return SPHC_E_ARGUMENT;
  if (!Camera(*camera).project(point, &pixel)) return SPHC_OUTSIDE;
  pixel_px[0] = pixel.x();
  pixel_px[1] = pixel.y();
  return SPHC_OK;
}

sphc_status sphc_camera_unproject(const sphc_camera *camera, const double pixel_px[2], double bearing[3]) {
  if (!camera || !pixel_px || !bearing || !sphc::checkCamera(*camera, "camera", nullptr)) return SPHC_E_ARGUMENT;
  const Vector2 pixel(pixel_px[0], pixel_px[1]);
  Vector2 ray;
  if (!pixel.allFinite()) return SPHC_E_ARGUMENT;
  if (!Camera(*camera).unproject(pixel, &ray)) return SPHC_OUTSIDE;
  const Vector3 unit = Vector3(ray.x(), ray.y(), 1).normalized();
  for (int i = 0; i < 3; ++i) bearing[i] = unit[i];
  return SPHC_OK;
}

void sphc_rigid_compose(const sphc_rigid *c_from_b, const sphc_rigid *b_from_a, sphc_rigid *c_from_a) {
  if (!c_from_b || !b_from_a || !c_from_a) return;
  *c_from_a = sphc::rigidToC(sphc::rigidFromC(*c_from_b) * sphc::rigidFromC(*b_from_a));
}

void sphc_rigid_inverse(const sphc_rigid *b_from_a, sphc_rigid *a_from_b) {
  if (!b_from_a || !a_from_b) return;
  *a_from_b = sphc::rigidToC(sphc::rigidFromC(*b_from_a).inverse());
}

void sphc_rigid_apply(const sphc_rigid *b_from_a, const double x_a[3], double x_b[3]) {
  if (!b_from_a || !x_a || !x_b) return;
  const Vector3 x = sphc::rigidFromC(*b_from_a) * Vector3(x_a[0], x_a[1], x_a[2]);
  for (int i = 0; i < 3; ++i) x_b[i] = x[i];
}
