// A line as it is published: whoever attacks a line cloud has these and nothing else.
#pragma once
#include "runtime/geometry/rotation.h"

namespace sphc::host {

struct Line {
  Vector3 point_m;    // the one nearest to the origin, so that it says nothing of which points the line hides
  Vector3 direction;  // unit; its sign says nothing either: the first coordinate that is not 0 is positive

  // Of the line through a point; `along` need not be of unit length.
  static Line through(const Vector3 &point_m, const Vector3 &along) {
    Vector3 direction = along.normalized();
    for (int k = 2; k >= 0; --k)
      if (direction[k] != 0 && direction.head(k).isZero(0)) direction *= direction[k] < 0 ? -1 : 1;
    return {point_m - direction.dot(point_m) * direction, direction};
  }
  Vector3 moment() const { return point_m.cross(direction); }
};

}  // namespace sphc::host
