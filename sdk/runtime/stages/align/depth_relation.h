// How a second depth camera is off against the first: z of the first = z + offset + slope (z - mid).  A Kalman
// filter of the two, over what both have measured.
#pragma once
#include "runtime/geometry/rotation.h"

namespace sphc {

class DepthRelation {
 public:
  // z of a point in a colour camera's frame, and 1 sigma of it.
  struct Measured {
    double z_m, sigma_m;
  };

  // `sigma`: of offset in m and slope, before the first frame; zero: none, and nothing is learnt.
  void init(double mid_m, const Vector2 &sigma);
  void nextFrame();
  // One point, measured by both.
  void learn(const Measured &first, const Measured &second);
  // What the first would have measured.
  Measured asFirst(const Measured &second) const;

 private:
  // Of a difference that is linear in offset and slope: 1 and `beyond`.
  struct Difference {
    double mean, offset_spread, slope_spread, variance;
  };
  Difference at(double beyond) const;

  // Of offset, of both, of slope.
  struct Covariance {
    double offset = 0, shared = 0, slope = 0;
  };
  double mid_m_ = 0, offset_m_ = 0, slope_ = 0;
  Covariance prior_, now_;  // zero: known exactly
};

}  // namespace sphc
