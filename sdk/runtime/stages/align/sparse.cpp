#include "runtime/stages/align/sparse.h"

namespace sphc {
namespace {

constexpr int kMostSteps = 128;
constexpr double kJump = 0.03;  // relative depth step between neighbours that is an edge, not a slope

}  // namespace

SparseAligner::SparseAligner(const Camera &color, const Camera &depth, const Rigid &color_from_depth,
                             const DepthSensor &sensor)
    : color_(color), depth_(depth), depth_from_color_(color_from_depth.inverse()), sensor_(sensor) {
  registered_ = color == depth && rotationAngle(color_from_depth.rotation) < 1e-9 &&
                color_from_depth.translation_m.norm() < 1e-9;
}

// A colour ray is a curve in the depth image.  Walk along it from near to far, about a pixel a step, until the ray
// goes under the measured surface.
bool SparseAligner::findSurface(ImageView<uint16_t> depth, const Vector2 &ray, Vector2 *depth_pixel_px) const {
  const Vector3 direction = depth_from_color_.rotation * Vector3(ray.x(), ray.y(), 1);
  const Vector3 &origin = depth_from_color_.translation_m;
  Vector2 near_px, far_px;
  if (!depth_.project(origin + sensor_.min_m * direction, &near_px) ||
      !depth_.project(origin + sensor_.max_m * direction, &far_px))
    return false;
  const double length = (far_px - near_px).norm();
  const int steps = length < kMostSteps - 1 ? static_cast<int>(length) + 1 : kMostSteps;
  double last_gap = 0, last_measured = 0;
  Vector2 last_px = near_px;
  bool has_last = false;
  for (int i = 0; i <= steps; ++i) {
    // even steps in inverse depth are nearly even in pixels
    const double inverse = (1 / sensor_.min_m) + (1 / sensor_.max_m - 1 / sensor_.min_m) * i / steps;
    const Vector3 point = origin + direction / inverse;
    Vector2 px;
    if (!depth_.project(point, &px)) return false;
    const int u = floorToInt(static_cast<float>(px.x())), v = floorToInt(static_cast<float>(px.y()));
    if (u < 0 || v < 0 || u >= depth.width || v >= depth.height) {
      has_last = false;
      continue;
    }
    const double measured = depth.row(v)[u] * sensor_.unit_m;
    if (!(measured >= sensor_.min_m && measured <= sensor_.max_m)) continue;
    const double gap = point.z() - measured;  // > 0: under the surface
    if (gap >= 0) {
      if (!has_last) return *depth_pixel_px = px, steps <= 2;
      if (absOf(measured - last_measured) > kJump * measured) return false;  // slipped behind an edge
      const double share = last_gap / (last_gap - gap);
      *depth_pixel_px = last_px + share * (px - last_px);
      return true;
    }
    last_gap = gap, last_measured = measured, last_px = px, has_last = true;
  }
  return false;
}

bool SparseAligner::lift(ImageView<uint16_t> depth, const Vector2 &color_pixel_px, Vector3 *point_m,
                         double *sigma_m) const {
  Vector2 ray, depth_px = color_pixel_px;
  if (!color_.unproject(color_pixel_px, &ray)) return false;
  if (!registered_ && !findSurface(depth, ray, &depth_px)) return false;
  const PatchDepth patch = patchDepth(depth, sensor_, depth_px.x() - 0.5, depth_px.y() - 0.5);
  if (!(patch.depth_m > 0)) return false;
  // Along the colour ray to the plane at this depth before the depth camera.
  const Vector3 r(ray.x(), ray.y(), 1);
  const double slope = depth_from_color_.rotation.row(2).dot(r.transpose());
  if (!(slope > 0.1)) return false;
  const double z = (patch.depth_m - depth_from_color_.translation_m.z()) / slope;
  if (!(z > 0)) return false;
  *point_m = z * r;
  *sigma_m = patch.sigma_m / slope;
  return true;
}

bool SparseAligner::bearing(const Vector2 &color_pixel_px, Vector3 *bearing) const {
  Vector2 ray;
  if (!color_.unproject(color_pixel_px, &ray)) return false;
  *bearing = Vector3(ray.x(), ray.y(), 1).normalized();
  return true;
}

}  // namespace sphc
