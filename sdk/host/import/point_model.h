// The private point model: where the map's points really are.  It exists on the owner's workstation alone; nothing
// in host/audit/attack or on the device may see this type.
#pragma once
#include <vector>

#include "runtime/geometry/rotation.h"
#include "runtime/types/keypoint.h"
#include "spherecloud/spherecloud.h"

namespace sphc::host {

struct ModelPoint {
  Vector3 position_m;  // world frame of the recording
  Descriptor descriptor;
  double sigma_m;         // of the position, 1 sigma, from the depths that were merged
  uint32_t observations;  // mapping frames that saw it
};

struct PointModel {
  std::vector<ModelPoint> points;
  sphc_band band = SPHC_BAND_VISIBLE;  // of the images that described them
};

// Bounds of what files keep and maps are made of: whoever writes a point asks first, so that it can be read again.
constexpr double kFarthestM = 1e6;

inline bool isInRange(const Vector3 &position_m) {
  return position_m.allFinite() && position_m.norm() < kFarthestM;
}

inline bool isInRange(const ModelPoint &point) {
  return isInRange(point.position_m) && point.sigma_m >= 0 && point.sigma_m < kFarthestM;
}

}  // namespace sphc::host
