// A pose that was found, and how the camera has moved since.
#pragma once
#include "runtime/base/elementary.h"
#include "runtime/localizer/frame.h"

namespace sphc {

struct CarriedPose {
  uint32_t map = 0;  // its slot
  int64_t time_ns = 0;
  Rigid camera_from_map;
  uint32_t inliers = 0;
  bool is_carried = false;                       // by odometry, at every frame since
  Rigid moved;                                   // camera now from camera then
  double turn_variance = 0, shift_variance = 0;  // of it, an axis
  double lasting_m = 0;                          // 1 sigma: what errors of direction and of scale made of the way
  double between_m = 0;  // 1 sigma: what was not known of the camera's way between the images of its frame

  Rigid now() const { return moved * camera_from_map; }
  double turnSigma() const { return sqrtOf(turn_variance); }
  double shiftSigma() const { return hypotOf(sqrtOf(shift_variance), lasting_m); }

  void carry(const Rigid &step, const Odometry &odometry) {
    moved = step * moved;
    // They last, so what they make of the steps adds up.
    lasting_m += (turnSigma() + odometry.scale_sigma) * step.translation_m.norm();
    turn_variance += odometry.rotation_sigma_rad * odometry.rotation_sigma_rad;
    shift_variance += odometry.translation_sigma_m * odometry.translation_sigma_m;
  }
};

}  // namespace sphc
