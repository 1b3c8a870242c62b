#include <cmath>
#include <spherecloud/spherecloud.hpp>

#include "lab/negative/fault.h"

namespace sphc::host {
namespace {

// Odometry that is as sure of itself as before.
std::function<void(Sequence *)> changeOdometry(const std::function<void(uint32_t shot, sphc_rigid *)> &change) {
  return [change](Sequence *sequence) {
    for (uint32_t i = 0; i < sequence->shots.size(); ++i)
      if (sequence->shots[i].prior.flags) change(i, &sequence->shots[i].prior.odometry_from_camera);
  };
}

sphc_rigid turnAboutAxis(int axis, double deg) {
  sphc_rigid turn = spherecloud::identity();
  turn.q_wxyz[0] = std::cos(0.5 * deg * M_PI / 180);
  turn.q_wxyz[1 + axis] = std::sin(0.5 * deg * M_PI / 180);
  return turn;
}

// As after a loop is closed: from one frame on all poses are in a frame that lies elsewhere.
void jump(uint32_t shot, sphc_rigid *odometry_from_camera) {
  constexpr uint32_t kFirst = kSequenceFrames / 3;
  sphc_rigid jump = turnAboutAxis(1, 20);
  jump.t_m[0] = 0.5;
  if (shot >= kFirst) *odometry_from_camera = spherecloud::compose(jump, *odometry_from_camera);
}

}  // namespace

std::vector<SensorFault> odometryFaults() {
  const auto stand = [](uint32_t, sphc_rigid *pose) { *pose = spherecloud::identity(); };
  const auto invert = [](uint32_t, sphc_rigid *pose) { *pose = spherecloud::inverse(*pose); };
  const auto stay = [](uint32_t, sphc_rigid *pose) { pose->t_m[0] = pose->t_m[1] = pose->t_m[2] = 0; };
  // Of a camera that looks along -z, with y up.
  const auto takeOtherAxes = [](uint32_t, sphc_rigid *pose) {
    *pose = spherecloud::compose(*pose, turnAboutAxis(0, 180));
  };
  constexpr uint32_t disagrees = SPHC_FAULT_ODOMETRY_DISAGREES;
  return {{"odometry jumps", changeOdometry(jump), 0, true, false},
          {"odometry stands still", changeOdometry(stand), disagrees, true, false},
          {"odometry inverted", changeOdometry(invert), disagrees, true, false},
          {"odometry of other axes", changeOdometry(takeOtherAxes), disagrees, true, false},
          {"odometry without shifts", changeOdometry(stay), disagrees, true, false}};
}

}  // namespace sphc::host
