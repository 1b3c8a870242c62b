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

}  // namespace sphc::host
