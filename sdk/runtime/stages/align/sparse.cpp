#include "runtime/stages/align/sparse.h"

#include <algorithm>

namespace sphc {
namespace {

constexpr int kMostSteps = 128;
constexpr double kJump = 0.03;  // relative depth step between neighbours that is an edge, not a slope
constexpr double kStridePx = DepthBlocks::kReachPx - 4;  // a margin, as steps are not quite even
constexpr double kBeyond = 1e6;                          // pixels: outside of every image

struct Cell {
  int u, v;
};
int cellAt(double px) { return floorToInt(static_cast<float>(std::min(std::max(px, -kBeyond), kBeyond))); }
Cell cellOf(const Vector2 &px) { return {cellAt(px.x()), cellAt(px.y())}; }

}  // namespace

// A colour ray as a curve in the depth image, in `steps` steps from near to far of about a pixel each: even ones in
// inverse depth, which are nearly even in pixels.  Points are homogeneous, (x, y, z) times the inverse depth, and
// so linear in the step.
struct SparseAligner::Walk {
  enum Place { kNowhere, kOutside, kHole, kTopView, kUnder };

  const Camera &camera;
  const DepthSensor &sensor;
  ImageView<uint16_t> depth;
  Vector3 near, change;                 // of the point: at step 0, and a step
  double near_inverse, inverse_change;  // of the depth along the colour ray
  double px_per_step;
  int steps;

  double inverseAt(int step) const { return near_inverse + inverse_change * step; }

  bool project(const Vector3 &point, Vector2 *px) const {
    const double *k = camera.parameters().params;
    if (!camera.isPinhole()) return camera.project(point, px);
    if (!(point.z() > 0)) return false;
    const double inverse = 1 / point.z();
    *px = Vector2(k[0] * (point.x() * inverse) + k[2], k[1] * (point.y() * inverse) + k[3]);
    return true;
  }

  // Where a step lies, against the surface measured there.  `gap`: how far below it, times the inverse depth.
  Place look(int step, Vector2 *px, double *measured, double *gap) const {
    const Vector3 point = near + change * step;
    if (!project(point, px)) return kNowhere;
    const Cell cell = cellOf(*px);
    if (cell.u < 0 || cell.v < 0 || cell.u >= depth.width || cell.v >= depth.height) return kOutside;
    *measured = depth.row(cell.v)[cell.u] * sensor.unit_m;
    if (!(*measured >= sensor.min_m && *measured <= sensor.max_m)) return kHole;
    *gap = point.z() - *measured * inverseAt(step);
    return *gap >= 0 ? kUnder : kTopView;
  }
};

void SparseAligner::setCameras(const Camera &color, const Camera &depth, const Rigid &color_from_depth) {
  color_ = color;
  depth_ = depth;
  depth_from_color_ = color_from_depth.inverse();
  registered_ = color_ == depth_ && rotationAngle(color_from_depth.rotation) < 1e-9 &&
                color_from_depth.translation_m.norm() < 1e-9;
}

void SparseAligner::prepare(ImageView<uint16_t> depth, bool for_others) {
  if (blocks_.hasMemory() && (for_others || !registered_)) blocks_.build(depth, sensor_);
}

// The first step at which the ray is as deep as `nearest`, a measurement; `never` where it does not get deeper.
double SparseAligner::stepOfDepth(const Walk &walk, uint16_t nearest, double never) const {
  const double nearest_m = nearest * sensor_.unit_m;
  const double approach = walk.change.z() - nearest_m * walk.inverse_change;
  return approach > 0 ? (nearest_m * walk.near_inverse - walk.near.z()) / approach : never;
}

// The first step that may be under anything in the image.
int SparseAligner::first(const Walk &walk) const {
  if (!blocks_.hasMemory() || blocks_.nearest() == DepthBlocks::kNone) return 0;
  const double at = stepOfDepth(walk, blocks_.nearest(), 0);
  return at > 0 ? static_cast<int>(at < walk.steps ? at : walk.steps) : 0;
}

// The step after `step`, which lies in the image, at which the ray may go under a surface.
int SparseAligner::next(const Walk &walk, int step, const Vector2 &px) const {
  if (!blocks_.hasMemory()) return step + 1;
  const Cell cell = cellOf(px);
  const uint16_t nearest = blocks_.nearest(cell.u, cell.v);
  double at = step + kStridePx / walk.px_per_step;
  if (nearest != DepthBlocks::kNone) {
    const double under = stepOfDepth(walk, nearest, step);
    if (under < at) at = under;
  }
  return at > step + 1 ? static_cast<int>(at) : step + 1;
}

// Walks along the ray until it goes under the measured surface.
bool SparseAligner::findSurface(ImageView<uint16_t> depth, const Vector2 &ray, Vector2 *depth_pixel_px) const {
  const Vector3 direction = depth_from_color_.rotation * Vector3(ray.x(), ray.y(), 1);
  const Vector3 &origin = depth_from_color_.translation_m;
  Vector2 near_px, far_px;
  if (!depth_.project(origin + sensor_.min_m * direction, &near_px) ||
      !depth_.project(origin + sensor_.max_m * direction, &far_px))
    return false;
  const double length = (far_px - near_px).norm();
  const int steps = length < kMostSteps - 1 ? static_cast<int>(length) + 1 : kMostSteps;
  const double near_inverse = 1 / sensor_.min_m, inverse_change = (1 / sensor_.max_m - near_inverse) / steps;
  const Walk walk = {depth_,
                     sensor_,
                     depth,
                     direction + near_inverse * origin,
                     inverse_change * origin,
                     near_inverse,
                     inverse_change,
                     length / steps + 1e-3,
                     steps};

  Vector2 px = near_px, last_px;
  double measured = 0, gap = 0, last_measured = 0, last_gap = 0;
  for (int step = first(walk); step <= steps;) {
    Walk::Place place = walk.look(step, &px, &measured, &gap);
    if (place == Walk::kNowhere) return false;
    if (place != Walk::kUnder) {
      step = place == Walk::kOutside ? step + 1 : next(walk, step, px);
      continue;
    }
    // Finds the last measurement that the ray passed in front of; a step outside the image forgets those before.
    place = Walk::kHole;
    int last_step = step;
    while (last_step > 0 && place == Walk::kHole)
      place = walk.look(--last_step, &last_px, &last_measured, &last_gap);
    if (place != Walk::kTopView) return *depth_pixel_px = px, steps <= 2;
    if (absOf(measured - last_measured) > kJump * measured) return false;  // slipped behind an edge
    last_gap *= walk.inverseAt(step);                                      // both by the product of the two
    gap *= walk.inverseAt(last_step);
    const double share = last_gap / (last_gap - gap);
    *depth_pixel_px = last_px + share * (px - last_px);
    return true;
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
