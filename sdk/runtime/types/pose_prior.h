// What else is known of a pose before its frame is looked at.
#pragma once
#include "runtime/geometry/rigid.h"

namespace sphc {

struct PosePrior {
  bool has_pose = false;
  Rigid camera_from_map;
  double rotation_sigma_rad = 0, translation_sigma_m = 0;  // 1 sigma an axis; translation of the camera's centre

  bool has_up = false;
  Vector3 up_camera = Vector3::Zero(), up_map = Vector3::Zero();  // unit, the same vertical in both frames
  double up_sigma_rad = 0;                                        // 1 sigma an axis
};

}  // namespace sphc
