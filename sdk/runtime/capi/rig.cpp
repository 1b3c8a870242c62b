#include "runtime/base/elementary.h"
#include "runtime/base/message.h"
#include "runtime/geometry/camera.h"
#include "runtime/stages/features/config.h"

using sphc::MessageWriter;

// What passes the check has keypoints.
static_assert(int32_t{SPHC_CAMERA_MIN_PX} == sphc::kMinImageSide &&
              int32_t{SPHC_CAMERA_MAX_PX} == sphc::kMaxImageSide);

namespace {

bool checkOffset(const double t_m[3], sphc_message *message) {
  for (int i = 0; i < 3; ++i) {
    if (sphc::absOf(t_m[i]) <= SPHC_RIG_MAX_OFFSET_M) continue;
    MessageWriter(message) << "color_from_depth.t_m[" << i << "] is " << t_m[i] << "; it must lie in "
                           << -SPHC_RIG_MAX_OFFSET_M << " to " << SPHC_RIG_MAX_OFFSET_M << ": give metres";
    return false;
  }
  return true;
}

bool checkRotation(const double q_wxyz[4], sphc_message *message) {
  double squared = 0;
  for (int i = 0; i < 4; ++i) squared += q_wxyz[i] * q_wxyz[i];
  if (sphc::absOf(squared - 1) <= 2 * SPHC_RIG_MAX_LENGTH_ERROR) return true;
  MessageWriter(message) << "color_from_depth.q_wxyz has length " << sphc::sqrtOf(squared)
                         << "; it must be 1 (order w x y z): divide by its length";
  return false;
}

bool checkUnit(double unit_m, sphc_message *message) {
  if (unit_m >= SPHC_RIG_MIN_UNIT_M && unit_m <= SPHC_RIG_MAX_UNIT_M) return true;
  MessageWriter(message) << "depth_unit_m is " << unit_m << "; it must lie in " << SPHC_RIG_MIN_UNIT_M << " to "
                         << SPHC_RIG_MAX_UNIT_M << " (0.001 for millimetres)";
  return false;
}

}  // namespace

void sphc_rig_init(sphc_rig *rig) {
  if (!rig) return;
  *rig = {};
  rig->color_from_depth.q_wxyz[0] = 1;
  rig->depth_unit_m = 0.001;
}

sphc_status sphc_rig_check(const sphc_rig *rig, sphc_message *message) {
  if (!rig) {
    MessageWriter(message) << "rig is null; give one";
    return SPHC_E_ARGUMENT;
  }
  const bool good = sphc::checkCamera(rig->color_camera, "color_camera", message) &&
                    sphc::checkCamera(rig->depth_camera, "depth_camera", message) &&
                    checkOffset(rig->color_from_depth.t_m, message) &&
                    checkRotation(rig->color_from_depth.q_wxyz, message) && checkUnit(rig->depth_unit_m, message);
  return good ? SPHC_OK : SPHC_E_ARGUMENT;
}
