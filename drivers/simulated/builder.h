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
  uint64_t style, seed;
};

struct Finish {
  Material material;
  float texel_m = 0.003f;
};

class Builder {
 public:
  // `arrangement_seed`: other than 0 says where things that people move are instead.
  Builder(uint64_t seed, uint64_t arrangement_seed)
      : rng_(seed), arrangement_(hash64(seed, arrangement_seed)), rearranged_(arrangement_seed != 0) {}
  Rng &rng() { return rng_; }

  // A new piece: what is added from here on shares its kinds of wood and cloth.
  void newStyle() { style_ = rng_.next(); }

  // What `add` adds follows from `seed` alone: twice with one seed gives the same piece twice.
  template <class Add>
  void repeatably(uint64_t seed, const Add &add) {
    const Rng outer = rng_;
    rng_ = Rng(seed);
    add();
    rng_ = outer;
  }

  // add(place) adds something that people move.  Rearranged, it may stand up to `slack_m` from there and turned, or
  // be left out; all other things stay as they were.
  template <class Add>
  void movable(const Place &place, double slack_m, const Add &add) {
    const bool outer = left_out_;
    const Place moved = rearranged_ ? rearrange(place, slack_m) : place;
    add(moved);
    left_out_ = outer;
  }

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

  // A solid as it is: world_from_solid is `turn` and `center`.
  void solid(Kind kind, const Vec3d &center, const Mat3d &turn, const Vec3d &half, const Finish faces[kMaxFaces]);

  std::vector<Shape> shapes;
  std::vector<Job> jobs;
  TexturePool pool;

 private:
  void add(Kind kind, const Place &place, const Vec3d &center, const Vec3d &half, const Mat3d &turn,
           const Finish faces[kMaxFaces]);

  // Where a thing is after the rearrangement; sets left_out_ where it is gone.
  Place rearrange(const Place &place, double slack_m);

  Rng rng_, arrangement_;
  bool rearranged_, left_out_ = false;
  uint64_t style_ = 0;
};

}  // namespace sphc::simulated
