// body.h - bodies of cylinders, ellipsoids and boxes, in a pose.
#pragma once

#include <vector>

#include "drivers/simulated/paint.h"
#include "drivers/simulated/shape.h"

namespace sphc::simulated {

// A solid of a body: body_from_part is `turn` and `center`.
struct Part {
  Kind kind;
  Vec3d center;
  Mat3d turn;
  Vec3d half;
  Material material;
};
using Body = std::vector<Part>;

// `step` runs through 2 pi from one step of the left foot to the next.  Bodies stand on the floor at their origin:
// x to the right, y to the front, z up; metres.  A body has the same parts of the same sizes in every pose.
Body walkingBody(double step);
// From the hips down.
Body walkingLegs(double step);
// The lower arms as their owner's eyes see them: x to the right, y down, z ahead; `drop_m` below where they are
// held.
Body raisedArms(double left_drop_m, double right_drop_m);

}  // namespace sphc::simulated
