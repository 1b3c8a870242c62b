// shape.h - the solids the room is made of, and where a ray meets them.
#pragma once

#include <cstdint>

#include "drivers/simulated/vec.h"

namespace sphc::simulated {

constexpr float kFar = 1e9f;

// Each is an affine image of a unit solid in [-1, 1]^3: kRoom is a box seen from inside, kCylinder stands along
// local z.
enum class Kind : uint8_t { kRoom, kBox, kCylinder, kEllipsoid };

// Faces.  Box and room: 2 * axis + (1 on the positive side).  Cylinder: 0 side, 1 top, 2 bottom.  Ellipsoid: 0.
constexpr int kMaxFaces = 6;
int faceCount(Kind kind);

struct Shape {
  Kind kind = Kind::kBox;
  Mat3f local_from_world{};  // rotation alone
  Vec3f center{}, half{};
  uint32_t texture[kMaxFaces] = {};
};

// A ray in a shape's unit space; its parameter t is that of the ray in the world.
struct LocalRay {
  Vec3f origin, direction;
};
LocalRay localRay(const Shape &shape, const Vec3f &origin, const Vec3f &direction);

// First t in (t_min, t_max) at which the ray enters the solid (kRoom: leaves it); kFar if none.
float intersect(Kind kind, const LocalRay &ray, float t_min, float t_max);

// What the ray sees at parameter t.
struct Contact {
  int face;
  float u, v;    // [0, 1] on the face; v runs down for sides
  Vec3f normal;  // unit space, pointing at the viewer, not normalised
};
Contact contact(Kind kind, const LocalRay &ray, float t);

// Point (unit space) and outward normal (world, unit) of a face at (u, v): the inverse of `contact`.
void facePoint(const Shape &shape, int face, float u, float v, Vec3f *point, Vec3f *normal);
// Extent of a face in metres along u and v.
void faceSize(const Shape &shape, int face, float *width_m, float *height_m);

// World normal of a unit-space normal.
Vec3f worldNormal(const Shape &shape, const Vec3f &unit_normal);
Vec3f worldPoint(const Shape &shape, const Vec3f &unit_point);
// Distance of a point outside a box (or a bounding box of another kind); for kRoom from its inside.
float distanceTo(const Shape &shape, const Vec3f &point);

}  // namespace sphc::simulated
