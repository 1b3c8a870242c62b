#include "runtime/base/message.h"
#include "runtime/capi/transform.h"
#include "runtime/geometry/camera.h"
#include "runtime/stages/features/config.h"

using sphc::MessageWriter;

// What passes the check has keypoints.
static_assert(int32_t{SPHC_CAMERA_MIN_PX} == sphc::kMinImageSide &&
              int32_t{SPHC_CAMERA_MAX_PX} == sphc::kMaxImageSide);

namespace {

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
  const bool good =
      sphc::checkCamera(rig->color_camera, "color_camera", message) &&
      sphc::checkCamera(rig->depth_camera, "depth_camera", message) &&
      sphc::checkTransform("color_from_depth", rig->color_from_depth, SPHC_RIG_MAX_OFFSET_M, message) &&
      checkUnit(rig->depth_unit_m, message);
  return good ? SPHC_OK : SPHC_E_ARGUMENT;
}
