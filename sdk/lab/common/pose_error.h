// How far a pose is from the truth; both are camera_from_map.
#pragma once
#include "runtime/geometry/rigid.h"

namespace sphc::host {

// Of the camera's centre.
inline double shiftM(const Rigid &found, const Rigid &truth) {
  return (found.inverse().translation_m - truth.inverse().translation_m).norm();
}

inline double turnRad(const Rigid &found, const Rigid &truth) {
  return rotationAngle(found.rotation * truth.rotation.transpose());
}

}  // namespace sphc::host
