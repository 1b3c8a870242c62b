#include "drivers/simulated/raster.h"

#include <algorithm>
#include <utility>

namespace sphc::simulated {
namespace {

// The camera moves and turns a little within an exposure, and rays leave the pixel's centre a little.
constexpr float kMargin = 0.012f;
constexpr float kNear = 0.02f;

// The camera that would see, without the mirror, what this one sees in it.  Its rotation is turned inside out.
Pose mirrored(const Pose &pose, const Vec3d &point, const Vec3d &normal) {
  const auto flip = [&](const Vec3d &v) { return v - normal * (2 * dot(v, normal)); };
  const Mat3d columns = transposed(pose.rotation);
  return {transposed(Mat3d{{flip(columns.row[0]), flip(columns.row[1]), flip(columns.row[2])}}),
          flip(pose.center - point) + point};
}

}  // namespace

Raster::Local Raster::localOf(const Shape &shape, const Poses &poses) {
  Local local{};
  const Vec3f scale{1 / shape.half.x, 1 / shape.half.y, 1 / shape.half.z};
  for (uint32_t i = 0; i < kLanes; ++i) {
    const Mat3f m = shape.local_from_world * toFloat(poses.lane[i].rotation);
    // The difference in double: it decides a depth.
    const Vec3f o = shape.local_from_world * toFloat(poses.lane[i].center - toDouble(shape.center));
    const auto put = [&](Vec4 &to, float x, float y, float z) {
      to.x[i] = x * scale.x;
      to.y[i] = y * scale.y;
      to.z[i] = z * scale.z;
    };
    put(local.origin, o.x, o.y, o.z);
    put(local.x, m.row[0].x, m.row[1].x, m.row[2].x);
    put(local.y, m.row[0].y, m.row[1].y, m.row[2].y);
    put(local.z, m.row[0].z, m.row[1].z, m.row[2].z);
  }
  return local;
}

Raster::Raster(const TexturePool &pool, const std::vector<Shape> &shapes, const sphc_camera &camera,
               const RayTable &rays, const Poses &poses)
    : pool_(pool), shapes_(shapes), rays_(rays), width_(camera.width), height_(camera.height), cut_(poses.lane[0]) {
  locals_.reserve(shapes.size());
  for (const Shape &shape : shapes) locals_.push_back(localOf(shape, poses));
  measure();
}

Raster::Raster(const Scene &scene, const std::vector<Shape> &shapes, const sphc_camera &camera,
               const RayTable &rays, const Poses &poses)
    : Raster(scene.pool, shapes, camera, rays, poses) {
  for (const Portal &portal : scene.portals) {
    Poses there = poses;
    if (portal.mirrors) {
      const Shape &glass = shapes[portal.shape];
      Vec3f point, normal;
      facePoint(glass, 3, 0.5f, 0.5f, &point, &normal);
      for (Pose &pose : there.lane) pose = mirrored(pose, toDouble(worldPoint(glass, point)), toDouble(normal));
    }
    const std::vector<Shape> &seen = portal.mirrors ? shapes : scene.outdoors;
    beyond_.push_back({portal.shape, std::unique_ptr<Raster>(new Raster(scene.pool, seen, camera, rays, there))});
  }
}

// Projects each shape's box; edges that cross the plane z = kNear are cut there.
void Raster::measure() {
  const Pose &pose = cut_;
  const Mat3f camera_from_world = toFloat(transposed(pose.rotation));
  for (uint32_t i = 1; i < shapes_.size(); ++i) {
    Vec3f corner[8];
    for (int c = 0; c < 8; ++c) {
      const Vec3f unit{(c & 1) != 0 ? 1.0f : -1.0f, (c & 2) != 0 ? 1.0f : -1.0f, (c & 4) != 0 ? 1.0f : -1.0f};
      corner[c] = camera_from_world * (worldPoint(shapes_[i], unit) - toFloat(pose.center));
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

void Raster::gatherAll(uint32_t left, uint32_t top, uint32_t right, uint32_t bottom, List &list) const {
  gather(left, top, right, bottom, list.straight);
  for (size_t i = 0; i < beyond_.size(); ++i) {
    const bool seen = std::any_of(list.straight.begin(), list.straight.end(),
                                  [&](uint32_t e) { return extents_[e].shape == beyond_[i].shape; });
    if (seen) beyond_[i].raster->gather(left, top, right, bottom, list.beyond[i]);
  }
}

void Raster::gather(uint32_t left, uint32_t top, uint32_t right, uint32_t bottom,
                    std::vector<uint32_t> &list) const {
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

LocalRay Raster::local(uint32_t shape, uint32_t lane, const Ray2 &ray) const {
  const Local &l = locals_[shape];
  const auto of = [lane](const Vec4 &v) { return Vec3f{v.x[lane], v.y[lane], v.z[lane]}; };
  return {of(l.origin), of(l.x) * ray.x + of(l.y) * ray.y + of(l.z)};
}

// Lowers each lane's hit to this shape where it is nearer.
void Raster::meet(uint32_t shape, const Rays &rays, Float4 x, Float4 y, Float4 from, Hits &hits,
                  Float4 &nearest) const {
  const Kind kind = shapes_[shape].kind;
  Float4 z = all(kFar);
  if (kind == Kind::kBox || kind == Kind::kRoom) {
    const Local &l = locals_[shape];
    Float4 enter = all(-kFar), leave = all(kFar);
    const auto slab = [&](Float4 origin, Float4 direction) {
      const Float4 tiny = all(1e-12f);
      const Float4 inverse = 1.0f / (direction * direction < tiny * tiny ? tiny : direction);
      const Float4 a = (-1.0f - origin) * inverse, b = (1.0f - origin) * inverse;
      enter = higher(enter, lower(a, b));
      leave = lower(leave, higher(a, b));
    };
    slab(l.origin.x, l.x.x * x + l.y.x * y + l.z.x);
    slab(l.origin.y, l.x.y * x + l.y.y * y + l.z.y);
    slab(l.origin.z, l.x.z * x + l.y.z * y + l.z.z);
    const Float4 at = kind == Kind::kRoom ? leave : enter;
    z = enter < leave ? at : z;
    z = at > from ? z : all(kFar);
  } else {
    for (uint32_t i = 0; i < kLanes; ++i) z[i] = intersect(kind, local(shape, i, rays.lane[i]), from[i], kFar);
  }
  for (uint32_t i = 0; i < kLanes; ++i) {
    if (z[i] < nearest[i]) hits.lane[i] = {z[i], shape, 0};
  }
  nearest = lower(nearest, z);
}

Hits Raster::cast(const List &list, const Rays &rays) const {
  Hits hits = castStraight(list.straight, rays, all(kNear));
  for (uint32_t k = 0; k < beyond_.size(); ++k) {
    bool through[kLanes], any = false;
    Float4 from = all(kNear);
    for (uint32_t i = 0; i < kLanes; ++i) {
      through[i] = hits.lane[i].portal == 0 && hits.lane[i].shape == beyond_[k].shape;
      if (through[i]) from[i] = hits.lane[i].z;
      any = any || through[i];
    }
    if (!any) continue;
    const Hits deeper = beyond_[k].raster->castStraight(list.beyond[k], rays, from);
    for (uint32_t i = 0; i < kLanes; ++i) {
      if (through[i]) hits.lane[i] = {deeper.lane[i].z, deeper.lane[i].shape, k + 1};
    }
  }
  return hits;
}

Hits Raster::castStraight(const std::vector<uint32_t> &list, const Rays &rays, Float4 from) const {
  const Float4 x{rays.lane[0].x, rays.lane[1].x, rays.lane[2].x, rays.lane[3].x};
  const Float4 y{rays.lane[0].y, rays.lane[1].y, rays.lane[2].y, rays.lane[3].y};
  Hits hits;
  Float4 nearest = all(kFar);
  const auto farthest = [&] {
    return std::max(std::max(nearest[0], nearest[1]), std::max(nearest[2], nearest[3]));
  };
  for (const uint32_t i : list) {
    const Extent &e = extents_[i];
    if (e.z - 2 * kMargin > farthest()) return hits;
    meet(e.shape, rays, x, y, from, hits, nearest);
  }
  // Nothing stands behind the walls.
  if (farthest() == kFar) meet(0, rays, x, y, from, hits, nearest);
  return hits;
}

Seen Raster::look(const Hit &hit, uint32_t lane, const Ray2 &ray) const {
  if (hit.portal != 0) return beyond_[hit.portal - 1].raster->look({hit.z, hit.shape, 0}, lane, ray);
  const Shape &shape = shapes_[hit.shape];
  const LocalRay in = local(hit.shape, lane, ray);
  const Contact where = contact(shape.kind, in, hit.z);
  // Both back in metres: a unit-space normal is divided by the half extents, a direction multiplied.
  const Vec3f n{where.normal.x / shape.half.x, where.normal.y / shape.half.y, where.normal.z / shape.half.z};
  const Vec3f d{in.direction.x * shape.half.x, in.direction.y * shape.half.y, in.direction.z * shape.half.z};
  const float cosine = -dot(n, d) / std::sqrt(dot(n, n) * dot(d, d));
  return {&pool_.painted(shape.texture[where.face]), where.u, where.v, std::max(cosine, 0.02f)};
}

}  // namespace sphc::simulated
