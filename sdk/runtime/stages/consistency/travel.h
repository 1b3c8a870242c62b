// Poses against odometry: how far the camera went, by each.  A common scale of all depths scales the camera's way
// in a sphere cloud and nothing else, so this is the only place where it shows.
#pragma once
#include "runtime/geometry/rotation.h"

namespace sphc {

class Travel {
 public:
  // The camera's centre by a pose and by odometry, each in a frame of its own; sigma: of the pose's, one axis;
  // variance: of odometry from the place before, along each axis.
  void add(const Vector3 &centre_in_map_m, const Vector3 &centre_in_odometry_m, double sigma_m,
           double way_variance_m2);
  void reset() { count_ = 0; }
  // Do the two disagree for sure?
  bool isScaled() const;

 private:
  static constexpr uint32_t kCapacity = 64;
  struct Place {
    Vector3 map_m, odometry_m;
    double sigma_m, way_variance_m2;
  };
  struct Spread {
    double map2 = 0, odometry2 = 0, sigma2 = 0;  // means of squares, m^2
    double way2 = 0;                             // sum of variances, m^2
  };
  Spread spread() const;

  Place places_[kCapacity];
  uint32_t count_ = 0, next_ = 0;
};

}  // namespace sphc
