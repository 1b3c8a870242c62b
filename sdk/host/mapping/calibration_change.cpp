#include "host/mapping/calibration_change.h"

#include <algorithm>
#include <cmath>
#include <iterator>

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

bool haveSameRays(const sphc_rig &rig) {
  const sphc_camera &color = rig.color_camera, &depth = rig.depth_camera;
  const Rigid color_from_depth = rigidFromC(rig.color_from_depth);
  if (!color_from_depth.translation_m.isZero(0) || !color_from_depth.rotation.isIdentity(0)) return false;
  const double across = static_cast<double>(depth.width) / color.width,
               down = static_cast<double>(depth.height) / color.height;
  const double scales[] = {across, down, across, down};  // of fx, fy, cx, cy
  constexpr double kRounded = 1e-6;                      // of numbers in a file
  for (int i = 0; i < 4; ++i)
    if (std::abs(depth.params[i] - scales[i] * color.params[i]) > kRounded * color.params[i]) return false;
  return color.model == depth.model && std::equal(color.params + 4, std::end(color.params), depth.params + 4);
}

sphc_rig changedBy(const CalibrationChange &change, const sphc_rig &rig) {
  sphc_rig changed = rig;
  changed.color_camera = changedLens(change.lens, rig.color_camera);
  if (haveSameRays(rig)) {
    changed.depth_camera = changedLens(change.lens, rig.depth_camera);
    return changed;
  }
  const Rigid move = {rotationFromVector(change.mount.head<3>()), Vector3(change.mount[3], change.mount[4], 0)};
  changed.color_from_depth = rigidToC(move * rigidFromC(rig.color_from_depth));
  return changed;
}

}  // namespace sphc::host
