// builder.h - collects the solids of the room and what their faces are to be painted with.
#pragma once

#include <vector>

#include "drivers/simulated/paint.h"
#include "drivers/simulated/shape.h"

namespace sphc::simulated {

// A place in the room: furniture is described with x to the side, y to the front and z up from here.
struct Place {
  Vec3d origin{};
  double yaw = 0;  // x turns towards y
};
Place at(const Place &place, double x, double y, double z = 0, double yaw = 0);

// How one face is painted.  Faces of equal size and seed look alike; a texel is the finest detail.
struct Job {
  uint32_t shape, texture;
  int face;
  Material material;
  uint64_t seed;
};

struct Finish {
  Material material;
  float texel_m = 0.003f;
};

class Builder {
 public:
  explicit Builder(uint64_t seed) : rng_(seed) {}
  Rng &rng() { return rng_; }

  // Half extents in metres; the centre is in the place's coordinates.
  void box(const Place &place, Vec3d center, Vec3d half, Finish all);
  // As box, but the face towards +y differs: a front, a spine, a picture.
  void boxWithFront(const Place &place, Vec3d center, Vec3d half, Finish all, Finish front);
  // As box, but the top differs.
  void boxWithTop(const Place &place, Vec3d center, Vec3d half, Finish all, Finish top);
  // As box, tilted by `tilt` radians about x so that its top leans back (towards -y).
  void tiltedBox(const Place &place, Vec3d center, Vec3d half, double tilt, Finish all);
  void cylinder(const Place &place, Vec3d center, double radius, double half_height, Finish side, Finish top);
  // A cylinder lying along the place's x axis.
  void roll(const Place &place, Vec3d center, double radius, double half_length, Finish all);
  void ellipsoid(const Place &place, Vec3d center, Vec3d half, double tilt, Finish all);
  // A disc on a wall: a short cylinder whose top faces +y.
  void wallDisc(const Place &place, Vec3d center, double radius, Finish rim, Finish top);
  // The room itself; materials of its six inner faces in the order of `Shape`'s faces.
  void room(const Vec3d &half, const Finish faces[kMaxFaces]);

  std::vector<Shape> shapes;
  std::vector<Job> jobs;
  TexturePool pool;

 private:
  void add(Kind kind, const Place &place, const Vec3d &center, const Vec3d &half, const Mat3d &turn,
           const Finish faces[kMaxFaces]);

  Rng rng_;
};

}  // namespace sphc::simulated
