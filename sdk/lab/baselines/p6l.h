// Perspective-six-lines: six rays of a camera, each meeting a known line.
#pragma once
#include <vector>

#include "host/audit/attack/line.h"
#include "runtime/geometry/rigid.h"

namespace sphc::host {

constexpr int kP6lLines = 6, kP6lMaxSolutions = 64;

// All real poses camera_from_map (R, t) in which the ray through the camera's centre along bearing[i] meets
// line[i]:
//
//     bearing_i . (R m_i + t x R d_i) = 0,   m_i the line's moment, d_i its direction,
//
// before it or behind it: nothing is asked of signs.  A degenerate problem (all lines through one point, say) has
// no isolated solutions; what comes out then is some of them or none.
//
// The problem is that of the relative pose of two generalised cameras, one of which is central (Stewenius, Nister,
// Oskarsson, Astrom, "Solutions to Minimal Generalized Relative Pose Problems", OMNIVIS 2005).  With the rotation
// as a quaternion the six equations are linear in (t, 1), so that the fifteen 4 x 4 minors vanish.  Each has the
// quaternion's squared length as a factor and leaves a form of degree 6; their products with the ten monomials of
// degree 2 span all 101 forms of degree 8 that vanish at the 64 solutions.  Multiplication in the 64 dimensions
// that are left is a matrix, whose eigenvectors are the solutions (Cox, Little, O'Shea, "Using Algebraic Geometry",
// chapter 2); Newton steps on the equations polish each.
std::vector<Rigid> solveP6l(const Vector3 bearing[kP6lLines], const Line line[kP6lLines]);

}  // namespace sphc::host
