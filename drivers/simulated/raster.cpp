#include "drivers/simulated/raster.h"

#include <algorithm>
#include <utility>

namespace sphc::simulated {
namespace {

// The camera moves and turns a little within an exposure, and rays leave the pixel's centre a little.
constexpr float kMargin = 0.012f;
constexpr float kNear = 0.02f;

}  // namespace

View makeView(const Scene &scene, const Pose &pose) {
  View view;
  view.world_from_camera = pose;
  view.locals.reserve(scene.shapes.size());
  const Mat3f rotation = toFloat(pose.rotation);
  for (const Shape &shape : scene.shapes) {
    const Mat3f m = shape.local_from_world * rotation;
    // In double: the difference of two places, a few metres from the origin, decides a depth.
    const Vec3f away = toFloat(pose.center - toDouble(shape.center));
    const Vec3f o = shape.local_from_world * away;
    const Vec3f scale{1 / shape.half.x, 1 / shape.half.y, 1 / shape.half.z};
    view.locals.push_back({{o.x * scale.x, o.y * scale.y, o.z * scale.z},
                           {m.row[0].x * scale.x, m.row[1].x * scale.y, m.row[2].x * scale.z},
                           {m.row[0].y * scale.x, m.row[1].y * scale.y, m.row[2].y * scale.z},
                           {m.row[0].z * scale.x, m.row[1].z * scale.y, m.row[2].z * scale.z}});
  }
  return view;
}

Raster::Raster(const Scene &scene, const sphc_camera &camera, const RayTable &rays, std::vector<View> views)
    : scene_(scene), rays_(rays), width_(camera.width), height_(camera.height), views_(std::move(views)) {
  measure();
}

// Projects each shape's box; edges that cross the plane z = kNear are cut there.
void Raster::measure() {
  const Pose &pose = views_[0].world_from_camera;
  const Mat3f camera_from_world = toFloat(transposed(pose.rotation));
  for (uint32_t i = 1; i < scene_.shapes.size(); ++i) {
    Vec3f corner[8];
    for (int c = 0; c < 8; ++c) {
      const Vec3f unit{(c & 1) != 0 ? 1.0f : -1.0f, (c & 2) != 0 ? 1.0f : -1.0f, (c & 4) != 0 ? 1.0f : -1.0f};
      corner[c] = camera_from_world * (worldPoint(scene_.shapes[i], unit) - toFloat(pose.center));
    }
    Extent e{kFar, kFar, -kFar, -kFar, kFar, i};
    const auto include = [&](const Vec3f &p) {
      e.x0 = std::min(e.x0, p.x / p.z);
      e.x1 = std::max(e.x1, p.x / p.z);
      e.y0 = std::min(e.y0, p.y / p.z);
      e.y1 = std::max(e.y1, p.y / p.z);
      e.z = std::min(e.z, p.z);
    };
    for (int a = 0; a < 8; ++a) {
      if (corner[a].z >= kNear) include(corner[a]);
      for (int bit = 1; bit < 8; bit <<= 1) {
        const int b = a | bit;
        if (b == a || (corner[a].z >= kNear) == (corner[b].z >= kNear)) continue;
        const float t = (kNear - corner[a].z) / (corner[b].z - corner[a].z);
        include(corner[a] + (corner[b] - corner[a]) * t);
      }
    }
    if (e.x0 < kFar) extents_.push_back(e);
  }
  std::sort(extents_.begin(), extents_.end(),
            [](const Extent &a, const Extent &b) { return a.z != b.z ? a.z < b.z : a.shape < b.shape; });
}

void Raster::gather(uint32_t left, uint32_t top, uint32_t right, uint32_t bottom, List &list) const {
  float x0 = kFar, y0 = kFar, x1 = -kFar, y1 = -kFar;
  // The tile's rim is bent by the lens: its corners and middles bound it to within the margin.
  for (const uint32_t row : {top, (top + bottom) / 2, bottom - 1}) {
    for (const uint32_t column : {left, (left + right) / 2, right - 1}) {
      const Ray2 &ray = rays_.center(column, row);
      x0 = std::min(x0, ray.x);
      x1 = std::max(x1, ray.x);
      y0 = std::min(y0, ray.y);
      y1 = std::max(y1, ray.y);
    }
  }
  list.clear();
  for (uint32_t i = 0; i < extents_.size(); ++i) {
    const Extent &e = extents_[i];
    if (e.x0 < x1 + kMargin && e.x1 > x0 - kMargin && e.y0 < y1 + kMargin && e.y1 > y0 - kMargin) list.push_back(i);
  }
}

Hit Raster::cast(const List &list, uint32_t view, const Ray2 &ray) const {
  Hit hit;
  for (const uint32_t i : list) {
    const Extent &e = extents_[i];
    if (e.z - 2 * kMargin > hit.z) break;
    const float z = intersect(scene_.shapes[e.shape].kind, local(e.shape, view, ray), kNear, hit.z);
    if (z < hit.z) hit = {z, e.shape};
  }
  // Nothing stands behind the walls.
  if (hit.z == kFar) hit = {intersect(Kind::kRoom, local(0, view, ray), kNear, kFar), 0};
  return hit;
}

Seen Raster::look(const Hit &hit, uint32_t view, const Ray2 &ray) const {
  const Shape &shape = scene_.shapes[hit.shape];
  const LocalRay in = local(hit.shape, view, ray);
  const Contact where = contact(shape.kind, in, hit.z);
  // Both back in metres: a unit-space normal is divided by the half extents, a direction multiplied.
  const Vec3f n{where.normal.x / shape.half.x, where.normal.y / shape.half.y, where.normal.z / shape.half.z};
  const Vec3f d{in.direction.x * shape.half.x, in.direction.y * shape.half.y, in.direction.z * shape.half.z};
  const float cosine = -dot(n, d) / std::sqrt(dot(n, n) * dot(d, d));
  return {&scene_.pool.texture(shape.texture[where.face]), where.u, where.v, std::max(cosine, 0.02f)};
}

}  // namespace sphc::simulated
