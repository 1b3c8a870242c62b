#include "drivers/simulated/shape.h"

#include <algorithm>
#include <cmath>

namespace sphc::simulated {
namespace {

float component(const Vec3f &v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }
Vec3f axisVector(int axis, float value) {
  return {axis == 0 ? value : 0.0f, axis == 1 ? value : 0.0f, axis == 2 ? value : 0.0f};
}

// Where a ray crosses the slab |coordinate| <= 1.  A direction of zero gives infinities that compare as they
// should.
inline void slab(float origin, float direction, float *enter, float *leave) {
  const float inverse = 1.0f / (std::fabs(direction) < 1e-12f ? 1e-12f : direction);
  const float a = (-1 - origin) * inverse, b = (1 - origin) * inverse;
  *enter = std::max(*enter, std::min(a, b));
  *leave = std::min(*leave, std::max(a, b));
}

float intersectCylinder(const LocalRay &ray, float t_min, float t_max) {
  const Vec3f &o = ray.origin, &d = ray.direction;
  float enter = -kFar, leave = kFar;
  slab(o.z, d.z, &enter, &leave);
  const float a = d.x * d.x + d.y * d.y;
  const float b = o.x * d.x + o.y * d.y;
  const float c = o.x * o.x + o.y * o.y - 1;
  const float discriminant = b * b - a * c;
  if (a < 1e-12f) {
    // Along the axis: only the caps count.
    if (c >= 0) return kFar;
  } else {
    if (discriminant <= 0) return kFar;
    const float root = std::sqrt(discriminant);
    enter = std::max(enter, (-b - root) / a);
    leave = std::min(leave, (-b + root) / a);
  }
  return enter < leave && enter > t_min && enter < t_max ? enter : kFar;
}

float intersectEllipsoid(const LocalRay &ray, float t_min, float t_max) {
  const float a = dot(ray.direction, ray.direction);
  const float b = dot(ray.origin, ray.direction);
  const float c = dot(ray.origin, ray.origin) - 1;
  const float discriminant = b * b - a * c;
  if (discriminant <= 0) return kFar;
  const float t = (-b - std::sqrt(discriminant)) / a;
  return t > t_min && t < t_max ? t : kFar;
}

// The viewer's right hand and up, as unit axes with signs, for a face whose normal towards the viewer is +-axis.
struct FaceFrame {
  int right_axis, up_axis;
  float right_sign, up_sign;
};
FaceFrame faceFrame(int axis, bool positive) {
  const float s = positive ? 1.0f : -1.0f;
  if (axis == 0) return {1, 2, s, 1};
  if (axis == 1) return {0, 2, -s, 1};
  return {0, 1, 1, s};
}

bool facesPositive(Kind kind, int face) { return ((face & 1) != 0) != (kind == Kind::kRoom); }

Contact boxContact(Kind kind, const Vec3f &p) {
  const Vec3f a{std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)};
  const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
  const int face = 2 * axis + (component(p, axis) > 0 ? 1 : 0);
  const bool positive = facesPositive(kind, face);
  const FaceFrame frame = faceFrame(axis, positive);
  return {face, 0.5f + 0.5f * frame.right_sign * component(p, frame.right_axis),
          0.5f - 0.5f * frame.up_sign * component(p, frame.up_axis), axisVector(axis, positive ? 1.0f : -1.0f)};
}

Contact cylinderContact(const Vec3f &p) {
  const float radius_sq = p.x * p.x + p.y * p.y;
  if (std::fabs(p.z) > 0.9999f && radius_sq < 0.9999f) {
    const float side = p.z > 0 ? 1.0f : -1.0f;
    return {p.z > 0 ? 1 : 2, 0.5f + 0.5f * p.x, 0.5f - 0.5f * side * p.y, {0, 0, side}};
  }
  return {0, 0.5f + std::atan2(p.y, p.x) / (2 * kFloatPi), 0.5f - 0.5f * p.z, {p.x, p.y, 0}};
}

Contact ellipsoidContact(const Vec3f &p) {
  return {0, 0.5f + std::atan2(p.y, p.x) / (2 * kFloatPi), 0.5f - 0.5f * std::clamp(p.z, -1.0f, 1.0f), p};
}

}  // namespace

int faceCount(Kind kind) {
  switch (kind) {
    case Kind::kCylinder:
      return 3;
    case Kind::kEllipsoid:
      return 1;
    default:
      return 6;
  }
}

LocalRay localRay(const Shape &shape, const Vec3f &origin, const Vec3f &direction) {
  const Vec3f o = shape.local_from_world * (origin - shape.center);
  const Vec3f d = shape.local_from_world * direction;
  const Vec3f &h = shape.half;
  return {{o.x / h.x, o.y / h.y, o.z / h.z}, {d.x / h.x, d.y / h.y, d.z / h.z}};
}

float intersect(Kind kind, const LocalRay &ray, float t_min, float t_max) {
  if (kind == Kind::kCylinder) return intersectCylinder(ray, t_min, t_max);
  if (kind == Kind::kEllipsoid) return intersectEllipsoid(ray, t_min, t_max);
  float enter = -kFar, leave = kFar;
  slab(ray.origin.x, ray.direction.x, &enter, &leave);
  slab(ray.origin.y, ray.direction.y, &enter, &leave);
  slab(ray.origin.z, ray.direction.z, &enter, &leave);
  const float t = kind == Kind::kRoom ? leave : enter;
  return enter < leave && t > t_min && t < t_max ? t : kFar;
}

Contact contact(Kind kind, const LocalRay &ray, float t) {
  const Vec3f p = ray.origin + ray.direction * t;
  switch (kind) {
    case Kind::kCylinder:
      return cylinderContact(p);
    case Kind::kEllipsoid:
      return ellipsoidContact(p);
    default:
      return boxContact(kind, p);
  }
}

void facePoint(const Shape &shape, int face, float u, float v, Vec3f *point, Vec3f *normal) {
  if (shape.kind == Kind::kRoom || shape.kind == Kind::kBox) {
    const int axis = face / 2;
    const bool positive = facesPositive(shape.kind, face);
    const FaceFrame frame = faceFrame(axis, positive);
    *point = axisVector(axis, (face & 1) != 0 ? 1.0f : -1.0f) +
             axisVector(frame.right_axis, frame.right_sign * (2 * u - 1)) +
             axisVector(frame.up_axis, frame.up_sign * (1 - 2 * v));
    *normal = worldNormal(shape, axisVector(axis, positive ? 1.0f : -1.0f));
    return;
  }
  const float angle = (u - 0.5f) * 2 * kFloatPi;
  if (shape.kind == Kind::kEllipsoid) {
    const float z = 1 - 2 * v;
    const float r = std::sqrt(std::max(0.0f, 1 - z * z));
    *point = {r * std::cos(angle), r * std::sin(angle), z};
    *normal = worldNormal(shape, *point);
  } else if (face == 0) {
    *point = {std::cos(angle), std::sin(angle), 1 - 2 * v};
    *normal = worldNormal(shape, {point->x, point->y, 0});
  } else {
    const float side = face == 1 ? 1.0f : -1.0f;
    *point = {2 * u - 1, side * (1 - 2 * v), side};
    *normal = worldNormal(shape, {0, 0, side});
  }
}

void faceSize(const Shape &shape, int face, float *width_m, float *height_m) {
  const Vec3f &h = shape.half;
  const float around = kFloatPi * (h.x + h.y);
  if (shape.kind == Kind::kCylinder) {
    *width_m = face == 0 ? around : 2 * h.x;
    *height_m = face == 0 ? 2 * h.z : 2 * h.y;
  } else if (shape.kind == Kind::kEllipsoid) {
    *width_m = around;
    *height_m = 2.2f * h.z + 0.8f * std::max(h.x, h.y);
  } else {
    const FaceFrame frame = faceFrame(face / 2, true);
    *width_m = 2 * component(h, frame.right_axis);
    *height_m = 2 * component(h, frame.up_axis);
  }
}

Vec3f worldNormal(const Shape &shape, const Vec3f &n) {
  const Vec3f local{n.x / shape.half.x, n.y / shape.half.y, n.z / shape.half.z};
  return normalized(transposed(shape.local_from_world) * local);
}

Vec3f worldPoint(const Shape &shape, const Vec3f &p) {
  return transposed(shape.local_from_world) * Vec3f{p.x * shape.half.x, p.y * shape.half.y, p.z * shape.half.z} +
         shape.center;
}

float distanceTo(const Shape &shape, const Vec3f &point) {
  const Vec3f p = shape.local_from_world * (point - shape.center);
  const Vec3f out{std::fabs(p.x) - shape.half.x, std::fabs(p.y) - shape.half.y, std::fabs(p.z) - shape.half.z};
  if (shape.kind == Kind::kRoom) return -std::max({out.x, out.y, out.z});
  return norm(Vec3f{std::max(out.x, 0.0f), std::max(out.y, 0.0f), std::max(out.z, 0.0f)});
}

}  // namespace sphc::simulated
