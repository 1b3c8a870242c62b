// What the pose stage works on: a lifted keypoint and the map direction it was matched to.
#pragma once
#include <cstdint>

#include "runtime/geometry/rotation.h"
#include "runtime/types/depth_calibration.h"

namespace sphc {

// A keypoint lifted by depth into the frame of the colour camera, with what is known of its error.  Without depth
// it is a viewing ray: point_m lies at 1 m on it, sideways_m is the error of the angle (metres at 1 m), along_m
// infinite.
struct LiftedPoint {
  Vector3 point_m;
  double sideways_m;  // 1 sigma across the viewing ray: pixel noise at this depth, and the map's own error
  double along_m;     // 1 sigma along the viewing ray: depth noise
  // Of the camera that saw it, which is another than the colour camera's in a rig of several.
  Eigen::Vector3f centre_m = Eigen::Vector3f::Zero();

  bool hasDepth() const { return isFinite(along_m); }
  // Unit.
  Vector3 view() const { return (point_m - centre_m.cast<double>()).normalized(); }
};

// As the sensor would have measured it without its bias, and with its noise as it is.
inline LiftedPoint corrected(const LiftedPoint &lifted, const DepthCalibration &depth) {
  LiftedPoint point = lifted;
  if (lifted.hasDepth()) point.point_m *= 1 + depth.correctionAt(lifted.point_m.z()) / lifted.point_m.z();
  point.along_m *= depth.noise_scale;
  return point;
}

struct Correspondence {
  LiftedPoint lifted;
  Vector3 direction;  // unit, map frame, from the sphere centre
  float quality = 0;  // of the match: larger is tried first; equal ones: no order
};

}  // namespace sphc
