// A step of an estimator's refinement.
#pragma once
#include "runtime/geometry/rigid.h"
#include "runtime/types/estimate.h"

namespace sphc::host {

// `step`: the rotation vector in the camera frame, radians, and the change of the translation, metres.
inline Rigid moved(const Rigid &camera_from_map, const Vector6 &step) {
  return {rotationFromVector(step.head<3>()) * camera_from_map.rotation,
          camera_from_map.translation_m + step.tail<3>()};
}

}  // namespace sphc::host
