// Perspective-three-point: three points in one frame, three rays through the origin of another.
#pragma once
#include "runtime/base/fixed_vector.h"
#include "runtime/geometry/rigid.h"

namespace sphc {

// Solves depth_i * bearing[i] = R point[i] + t with depth_i > 0 for up to four (R, t): ray_frame_from_point_frame.
// `bearing` are unit vectors, `point` in metres; no three points on a line.  Degenerate input yields no solution.
//
// The pencil of conics of Persson and Nordberg, "Lambda Twist: An Accurate Fast Robust Perspective Three Point
// (P3P) Solver" (ECCV 2018), with its degenerate member split into two lines as in Richter-Gebert, "Perspectives on
// Projective Geometry" (2011), section 11.1; depths are polished by Newton's method.
FixedVector<Rigid, 4> solveP3p(const Vector3 bearing[3], const Vector3 point[3]);

}  // namespace sphc
