// A frame of a walk as the mapper sees it: the device's own keypoints, with depth where there is some.
#pragma once
#include <vector>

#include "runtime/geometry/rotation.h"
#include "runtime/types/hint.h"
#include "runtime/types/keypoint.h"

namespace sphc::host {

struct SeenPoint {
  Vector2 ray = Vector2::Zero();      // (x, y, 1), camera frame
  double sigma = 0;                   // of the ray, 1 sigma of either coordinate
  double depth_m = 0;                 // z; 0: none
  double depth_sigma_m = 0;           // 1 sigma of it
  Vector3 bearing = Vector3::Zero();  // unit, along the ray

  bool hasDepth() const { return depth_m > 0; }
  Vector3 point_m() const { return Vector3(ray.x() * depth_m, ray.y() * depth_m, depth_m); }
};

struct WalkFrame {
  uint32_t index = 0;                   // in the recording
  std::vector<SeenPoint> points;        // strongest keypoint first
  std::vector<Descriptor> descriptors;  // of the same
  Hints hints = 0;                      // why the frame may be worth little
};

}  // namespace sphc::host
