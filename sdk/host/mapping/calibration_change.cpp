#include "host/mapping/calibration_change.h"

#include "runtime/geometry/camera.h"
#include "runtime/geometry/rigid.h"

namespace sphc::host {
namespace {

sphc_camera changedLens(const Vector3 &lens, sphc_camera camera) {
  double *params = camera.params;  // fx, fy, cx, cy
  params[2] += params[0] * lens[1];
  params[3] += params[1] * lens[2];
  params[0] *= 1 + lens[0];
  params[1] *= 1 + lens[0];
  return camera;
}

}  // namespace

Vector5 depthByMount(const SeenPoint &seen) {
  Vector5 by_mount;
  by_mount << seen.point_m().cross(seen.depth_by_move), seen.depth_by_move.head<2>();
  return by_mount;
}

bool isRegistered(const sphc_rig &rig) {
  const Rigid color_from_depth = rigidFromC(rig.color_from_depth);
  return Camera(rig.color_camera) == Camera(rig.depth_camera) && color_from_depth.translation_m.isZero(0) &&
         color_from_depth.rotation.isIdentity(0);
}

sphc_rig changedBy(const CalibrationChange &change, const sphc_rig &rig) {
  sphc_rig changed = rig;
  changed.color_camera = changedLens(change.lens, rig.color_camera);
  if (isRegistered(rig)) {
    changed.depth_camera = changed.color_camera;
    return changed;
  }
  const Rigid move = {rotationFromVector(change.mount.head<3>()), Vector3(change.mount[3], change.mount[4], 0)};
  changed.color_from_depth = rigidToC(move * rigidFromC(rig.color_from_depth));
  return changed;
}

}  // namespace sphc::host
