#include <cmath>
#include <spherecloud/spherecloud.hpp>

#include "lab/negative/fault.h"

namespace sphc::host {
namespace {

constexpr double kSurely = 1e-3;  // rad

void rotate(const sphc_rigid &pose, const double in[3], double out[3]) {
  sphc_rigid turn = pose;
  for (double &t : turn.t_m) t = 0;
  sphc_rigid_apply(&turn, in, out);
}

// The vertical is that of the recording's world, turned in the camera's frame.
std::function<void(Sequence *)> stateVertical(double off_deg) {
  return [off_deg](Sequence *sequence) {
    const double half = 0.5 * off_deg * M_PI / 180;
    const sphc_rigid wrong = {{std::cos(half), std::sin(half), 0, 0}, {0, 0, 0}};
    const double up_world[3] = {0, -1, 0};
    for (Shot &shot : sequence->shots) {
      if (!shot.world_from_camera) continue;
      sphc_localizer_prior prior = {};
      prior.struct_size = sizeof prior;
      prior.flags = SPHC_PRIOR_UP;
      for (int i = 0; i < 3; ++i) prior.up_map[i] = up_world[i];
      rotate(spherecloud::inverse(*shot.world_from_camera), up_world, prior.up_camera);
      rotate(wrong, prior.up_camera, prior.up_camera);
      prior.up_sigma_rad = kSurely;
      shot.prior = prior;
    }
  };
}

}  // namespace

std::vector<SensorFault> priorFaults() {
  return {{"healthy, vertical", stateVertical(0), 0, true, false},
          {"vertical 5 deg off, sure", stateVertical(5), SPHC_FAULT_VERTICAL_DISAGREES, true, false}};
}

}  // namespace sphc::host
