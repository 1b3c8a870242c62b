// By how much a calibration is off, to first order.
#pragma once
#include "host/mapping/walk_frame.h"
#include "spherecloud/spherecloud.h"

namespace sphc::host {

using Vector5 = Eigen::Matrix<double, 5, 1>;

struct CalibrationChange {
  Vector3 lens = Vector3::Zero();   // focal length, relative; principal point, in focal lengths
  Vector5 mount = Vector5::Zero();  // of color_from_depth: rotation vector in rad, shift along x and y in metres
};

// The ray that the calibration assumes of the pixel of a true ray (x, y, 1).
inline Vector2 assumedRay(const Vector2 &ray, const double *lens) {
  return {(1 + lens[0]) * ray.x() + lens[1], (1 + lens[0]) * ray.y() + lens[2]};
}

// d(depth along the ray) / d(mount).  A shift along the optical axis is not told from an offset of the depths.
Vector5 depthByMount(const SeenPoint &seen);

// Depth that lies on the colour image, be it of another size: both cameras see along the same rays.
bool haveSameRays(const sphc_rig &rig);

// The calibration after the change.  Both cameras change where they have the same rays; else the colour camera and
// color_from_depth do.
sphc_rig changedBy(const CalibrationChange &change, const sphc_rig &rig);

}  // namespace sphc::host
