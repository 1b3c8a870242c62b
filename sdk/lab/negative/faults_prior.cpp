#include <cmath>
#include <spherecloud/spherecloud.hpp>

#include "lab/negative/fault.h"

namespace sphc::host {
namespace {

constexpr double kSurely = 1e-3, kFairly = 1e-2;  // rad

void rotate(const sphc_rigid &pose, const double in[3], double out[3]) {
  sphc_rigid turn = pose;
  for (double &t : turn.t_m) t = 0;
  sphc_rigid_apply(&turn, in, out);
}

// The vertical is that of the recording's world, turned by `wrong` in the camera's frame.
std::function<void(Sequence *)> stateVertical(const sphc_rigid &wrong, double sigma_rad) {
  return [wrong, sigma_rad](Sequence *sequence) {
    const double up_world[3] = {0, -1, 0};
    for (Shot &shot : sequence->shots) {
      if (!shot.world_from_camera) continue;
      sphc_localizer_prior prior = {};
      prior.struct_size = sizeof prior;
      prior.flags = SPHC_PRIOR_UP;
      for (int i = 0; i < 3; ++i) prior.up_map[i] = up_world[i];
      rotate(spherecloud::inverse(*shot.world_from_camera), up_world, prior.up_camera);
      rotate(wrong, prior.up_camera, prior.up_camera);
      prior.up_sigma_rad = sigma_rad;
      shot.prior = prior;
    }
  };
}

// About the camera's x axis.
sphc_rigid turnedBy(double degrees) {
  const double half = 0.5 * degrees * M_PI / 180;
  return {{std::cos(half), std::sin(half), 0, 0}, {0, 0, 0}};
}

SensorFault wrongVertical(const char *name, double degrees, double sigma_rad) {
  return {name, stateVertical(turnedBy(degrees), sigma_rad), SPHC_FAULT_VERTICAL_DISAGREES, true, false};
}

}  // namespace

std::vector<SensorFault> priorFaults() {
  return {{"healthy, vertical", stateVertical(turnedBy(0), kSurely), 0, true, false},
          wrongVertical("vertical 5 deg off, sure", 5, kSurely),
          wrongVertical("vertical 20 deg off", 20, kFairly),
          wrongVertical("vertical of other axes", 90, kFairly),
          wrongVertical("vertical inverted", 180, kFairly)};
}

}  // namespace sphc::host
