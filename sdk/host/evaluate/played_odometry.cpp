#include "host/evaluate/played_odometry.h"

#include <cmath>
#include <spherecloud/spherecloud.hpp>

namespace sphc::host {
namespace {

// A small motion with independent normal errors an axis.
sphc_rigid disturbance(std::mt19937_64 *random) {
  std::normal_distribution<double> turn(0, PlayedOdometry::kRotationSigmaRad / 2);  // of half angles
  std::normal_distribution<double> shift(0, PlayedOdometry::kTranslationSigmaM);
  sphc_rigid made = spherecloud::identity();
  for (int i = 0; i < 3; ++i) {
    made.q_wxyz[i + 1] = turn(*random);
    made.t_m[i] = shift(*random);
  }
  const double x = made.q_wxyz[1], y = made.q_wxyz[2], z = made.q_wxyz[3];
  made.q_wxyz[0] = std::sqrt(1 - x * x - y * y - z * z);
  return made;
}

}  // namespace

const sphc_localizer_prior *PlayedOdometry::at(uint32_t index) {
  const std::optional<sphc_rigid> recorded = reader_->worldFromCamera(index);
  if (!recorded) {
    begun_ = false;
    return nullptr;
  }
  const sphc_rigid &world_from_camera = *recorded;
  if (!begun_) {
    prior_ = {};
    prior_.struct_size = sizeof prior_;
    prior_.flags = SPHC_PRIOR_ODOMETRY;
    prior_.odometry_from_camera = spherecloud::identity();
    prior_.odometry_rotation_sigma_rad = kRotationSigmaRad;
    prior_.odometry_translation_sigma_m = kTranslationSigmaM;
  } else {
    const sphc_rigid step = spherecloud::compose(spherecloud::inverse(world_from_camera_), world_from_camera);
    prior_.odometry_from_camera =
        spherecloud::compose(prior_.odometry_from_camera, spherecloud::compose(step, disturbance(&random_)));
  }
  begun_ = true;
  world_from_camera_ = world_from_camera;
  return &prior_;
}

}  // namespace sphc::host
