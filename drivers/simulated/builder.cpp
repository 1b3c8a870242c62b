#include "drivers/simulated/builder.h"

namespace sphc::simulated {
namespace {

// place_from_solid for a solid whose z axis leans towards -y by `tilt`.
Mat3d leaning(double tilt) {
  const double c = std::cos(tilt), s = std::sin(tilt);
  return {{{1, 0, 0}, {0, c, -s}, {0, s, c}}};
}

}  // namespace

Place at(const Place &place, double x, double y, double z, double yaw) {
  return {place.origin + yawRotation(place.yaw) * Vec3d{x, y, z}, place.yaw + yaw};
}

void Builder::add(Kind kind, const Place &place, const Vec3d &center, const Vec3d &half, const Mat3d &turn,
                  const Finish faces[kMaxFaces]) {
  if (left_out_) {
    // The others keep the numbers that they would have drawn.
    for (int face = 0; face < faceCount(kind); ++face) rng_.next();
    return;
  }
  Shape shape;
  shape.kind = kind;
  shape.local_from_world = toFloat(transposed(yawRotation(place.yaw) * turn));
  shape.center = toFloat(place.origin + yawRotation(place.yaw) * center);
  shape.half = toFloat(half);
  for (int face = 0; face < faceCount(kind); ++face) {
    float width = 0, height = 0;
    faceSize(shape, face, &width, &height);
    shape.texture[face] = pool.add(width, height, faces[face].texel_m);
    jobs.push_back({static_cast<uint32_t>(shapes.size()), shape.texture[face], face, faces[face].material, style_,
                    rng_.next()});
  }
  shapes.push_back(shape);
}

void Builder::solid(Kind kind, const Vec3d &center, const Mat3d &turn, const Vec3d &half,
                    const Finish faces[kMaxFaces]) {
  add(kind, Place{}, center, half, turn, faces);
}

Place Builder::rearrange(const Place &place, double slack_m) {
  const double lot = arrangement_.real();
  const double x = arrangement_.real(-slack_m, slack_m), y = arrangement_.real(-slack_m, slack_m);
  const double yaw = arrangement_.real(-1.2, 1.2);
  if (lot < 0.25) left_out_ = true;
  return lot < 0.5 || slack_m == 0 ? place : at(place, x, y, 0, yaw);
}

void Builder::box(const Place &place, Vec3d center, Vec3d half, Finish all) {
  boxWithFront(place, center, half, all, all);
}

void Builder::boxWithFront(const Place &place, Vec3d center, Vec3d half, Finish all, Finish front) {
  const Finish faces[kMaxFaces] = {
      all, all, {all.material, 4 * all.texel_m}, front, {all.material, 4 * all.texel_m}, all};
  add(Kind::kBox, place, center, half, kUpright, faces);
}

void Builder::boxWithTop(const Place &place, Vec3d center, Vec3d half, Finish all, Finish top) {
  const Finish faces[kMaxFaces] = {all, all, all, all, {all.material, 4 * all.texel_m}, top};
  add(Kind::kBox, place, center, half, kUpright, faces);
}

void Builder::tiltedBox(const Place &place, Vec3d center, Vec3d half, double tilt, Finish all) {
  const Finish faces[kMaxFaces] = {all, all, all, all, all, all};
  add(Kind::kBox, place, center, half, leaning(tilt), faces);
}

void Builder::cylinder(const Place &place, Vec3d center, double radius, double half_height, Finish side,
                       Finish top) {
  const Finish faces[kMaxFaces] = {side, top, side, side, side, side};
  add(Kind::kCylinder, place, center, {radius, radius, half_height}, kUpright, faces);
}

void Builder::roll(const Place &place, Vec3d center, double radius, double half_length, Finish all) {
  const Finish faces[kMaxFaces] = {all, all, all, all, all, all};
  const Mat3d lying{{{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}}};
  add(Kind::kCylinder, place, center, {radius, radius, half_length}, lying, faces);
}

void Builder::ellipsoid(const Place &place, Vec3d center, Vec3d half, double tilt, Finish all) {
  const Finish faces[kMaxFaces] = {all, all, all, all, all, all};
  add(Kind::kEllipsoid, place, center, half, leaning(tilt), faces);
}

void Builder::wallDisc(const Place &place, Vec3d center, double radius, Finish rim, Finish top) {
  const Finish faces[kMaxFaces] = {rim, top, rim, rim, rim, rim};
  // z of the solid to the front (+y), its y up, hence its x to the viewer's right: -x.
  const Mat3d facing{{{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}}};
  add(Kind::kCylinder, place, center, {radius, radius, 0.025}, facing, faces);
}

void Builder::room(const Vec3d &half, const Finish faces[kMaxFaces]) {
  add(Kind::kRoom, Place{{0, 0, half.z}, 0}, {}, half, kUpright, faces);
}

}  // namespace sphc::simulated
