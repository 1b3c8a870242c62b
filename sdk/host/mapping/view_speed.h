// How fast a view moves.
#pragma once
#include "runtime/geometry/rigid.h"

namespace sphc::host {

// The view moves by so much a second, as rays: a turn of 115 degrees, or 4 m/s past things 2 m away.
constexpr double kFastPerS = 2.0;

// As rays, of things so far away.
inline double viewShift(const Rigid &moved, double depth_m) {
  return rotationAngle(moved.rotation) + moved.translation_m.norm() / depth_m;
}

}  // namespace sphc::host
