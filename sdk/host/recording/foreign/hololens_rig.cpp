#include "host/recording/foreign/hololens_rig.h"

#include <optional>
#include <vector>

#include "host/base/median.h"
#include "host/cameras/rigid_matrix.h"
#include "host/recording/calibration_json.h"
#include "host/recording/failure.h"
#include "host/recording/foreign/comma_text.h"

namespace sphc::recording {

namespace {

constexpr int64_t kMostPvGapNs = 250000000;  // between colour poses around a depth image

std::optional<sphc_rigid> colorFromDepth(const PoseTrack &world_from_color, const PoseTrack &world_from_rig,
                                         const sphc_rigid &depth_from_rig) {
  sphc_rigid rig_from_depth;
  sphc_rigid_inverse(&depth_from_rig, &rig_from_depth);
  std::vector<double> q[4], t[3];
  for (const TimedPose &rig : world_from_rig.poses()) {
    sphc_rigid color_from_world, color_from_rig, sample;
    const std::optional<sphc_rigid> color = world_from_color.at(rig.time_ns, kMostPvGapNs);
    if (!color) continue;
    sphc_rigid_inverse(&*color, &color_from_world);
    sphc_rigid_compose(&color_from_world, &rig.pose, &color_from_rig);
    sphc_rigid_compose(&color_from_rig, &rig_from_depth, &sample);
    double alike = 0;  // to the first: a quaternion and its negative are one rotation
    for (int i = 0; i < 4; ++i) alike += q[i].empty() ? 1 : q[i].front() * sample.q_wxyz[i];
    for (int i = 0; i < 4; ++i) q[i].push_back(alike < 0 ? -sample.q_wxyz[i] : sample.q_wxyz[i]);
    for (int i = 0; i < 3; ++i) t[i].push_back(sample.t_m[i]);
  }
  if (t[0].empty()) return {};
  sphc_rigid middle = {{host::median(q[0]), host::median(q[1]), host::median(q[2]), host::median(q[3])},
                       {host::median(t[0]), host::median(t[1]), host::median(t[2])}};
  if (!host::normalizeQuaternion(middle.q_wxyz, 1e-2)) return {};
  return middle;
}

}  // namespace

sphc_rig rigOfHoloLens(const sphc_camera &color, const sphc_camera &depth, const PoseTrack &world_from_color,
                       const PoseTrack &world_from_rig, const sphc_rigid &depth_from_rig) {
  const std::optional<sphc_rigid> color_from_depth =
      colorFromDepth(world_from_color, world_from_rig, depth_from_rig);
  if (!color_from_depth)
    throw Failure(SPHC_E_ARGUMENT,
                  "colour and depth have no time at which both know where they are; record while the headset "
                  "knows its place, or give a calibration file");
  sphc_rig rig;
  sphc_rig_init(&rig);
  rig.color_camera = color;
  rig.depth_camera = depth;
  rig.color_from_depth = *color_from_depth;
  rig.depth_unit_m = 0.001;
  return requireGood(rig);
}

}  // namespace sphc::recording
