// Whitened distance from a lifted keypoint to its map ray: the statistically weighted form of "the keypoint lies
// along the positive direction of the ray" (paper, section 3.3).
//
// Camera frame.  The ray leaves t (the sphere centre) along n = R d; the lifted keypoint P has error `sideways`
// across its viewing ray v and `along` along it.  With W the inverse square root of that covariance the residual is
//     W (P - t - m n),   m = the value that makes it shortest.
// Two degrees of freedom; its square is chi-squared with 2 when the errors are as stated.
#pragma once
#include "runtime/geometry/rigid.h"
#include "runtime/types/correspondence.h"

namespace sphc {

struct Residual {
  Vector3 whitened;      // W (P - t - m n)
  Vector3 ray_whitened;  // W n / |W n|: the direction along which the residual says nothing
  Vector3 foot_m;        // t + m n: the point of the ray that is nearest in the metric W
  double squared;        // |whitened|^2
  bool in_front;         // m > 0: cheirality (supplement, section 1.1)
};

// W x for a keypoint seen along the unit vector `view`.
inline Vector3 whiten(const LiftedPoint &lifted, const Vector3 &view, const Vector3 &x) {
  const double sideways = 1 / lifted.sideways_m, along = 1 / lifted.along_m;
  return sideways * x + ((along - sideways) * view.dot(x)) * view;
}

Residual residualOf(const Correspondence &c, const Rigid &camera_from_map);
// What a shift of the lifted keypoint, in metres, adds to the whitened distance.
Matrix3 acrossRay(const LiftedPoint &lifted, const Residual &r);

}  // namespace sphc
