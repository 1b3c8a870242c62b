// Axes of cameras as other programs have them.
#pragma once

#include <spherecloud/spherecloud.h>

namespace sphc::recording {

// From axes right, up, back (ARKit, OpenGL, a HoloLens' colour camera) to ours, right, down, forward.
inline sphc_rigid fromUpBackAxes(const sphc_rigid &world_from_camera) {
  const sphc_rigid half_turn = {{0, 1, 0, 0}, {0, 0, 0}};  // about x: y and z the other way
  sphc_rigid turned;
  sphc_rigid_compose(&world_from_camera, &half_turn, &turned);
  return turned;
}

}  // namespace sphc::recording
