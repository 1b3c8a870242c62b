#include "runtime/localizer/known.h"

namespace sphc {
namespace {

Vector3 vectorOf(const double v[3]) { return Vector3(v[0], v[1], v[2]); }

}  // namespace

Known knownFromDoor(const sphc_prior *given) {
  Known known;
  if (!given) return known;
  known.map = given->map_index;
  PosePrior &prior = known.prior;
  prior.has_pose = given->flags & SPHC_PRIOR_POSE;
  if (prior.has_pose) {
    prior.camera_from_map = rigidFromDoor(given->camera_from_map);
    prior.rotation_sigma_rad = given->rotation_sigma_rad;
    prior.translation_sigma_m = given->translation_sigma_m;
  }
  prior.has_up = given->flags & SPHC_PRIOR_UP;
  if (prior.has_up) {
    prior.up_camera = vectorOf(given->up_camera).normalized();
    prior.up_map = vectorOf(given->up_map).normalized();
    prior.up_sigma_rad = given->up_sigma_rad;
  }
  known.has_odometry = given->flags & SPHC_PRIOR_ODOMETRY;
  if (known.has_odometry) {
    known.odometry = {rigidFromDoor(given->odometry_from_camera), given->odometry_rotation_sigma_rad,
                      given->odometry_translation_sigma_m};
  }
  return known;
}

}  // namespace sphc
