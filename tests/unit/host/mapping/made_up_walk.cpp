#include "made_up_walk.h"

#include <cmath>

#include "host/mapping/likely_pairs.h"
#include "tests/support/random_numbers.h"

namespace sphc::host {
namespace {

constexpr uint32_t kPoints = 1500;
constexpr double kFocalPx = 500, kWidest = 0.6;  // of a ray
constexpr double kRaySigma = 0.8 / kFocalPx;

struct RoomPoint {
  Vector3 position_m;
  Descriptor descriptor;
};

using test::normal;

// On the walls of a room of 6 x 5 x 3 m, and in it.
std::vector<RoomPoint> makeRoom(Random *random) {
  std::vector<RoomPoint> room(kPoints);
  for (RoomPoint &point : room) {
    const double angle = 2 * kPi * random->uniform(), distance_m = 1.8 + 1.4 * random->uniform();
    point.position_m = {distance_m * std::cos(angle), 2.4 * random->uniform() - 1.2, distance_m * std::sin(angle)};
    point.descriptor = test::randomDescriptor(random);
  }
  return room;
}

// On a small circle, looking outwards.
Rigid poseAt(double turn) {
  const Matrix3 rotation = rotationFromVector(Vector3(0.05 * std::sin(3 * turn), turn, 0));
  return {rotation, rotation * Vector3(0.1 * std::sin(2 * turn), 0.05 * std::cos(turn), 0.5)};
}

WalkFrame see(const std::vector<RoomPoint> &room, const Rigid &camera_from_world, const MadeUpOptions &options,
              Random *random) {
  WalkFrame frame;
  for (const RoomPoint &at : room) {
    const Vector3 point_m = camera_from_world * at.position_m;
    if (!(point_m.z() > 0.3)) continue;
    const Vector2 ray = point_m.head<2>() / point_m.z();
    if (ray.cwiseAbs().maxCoeff() > kWidest) continue;
    SeenPoint seen;
    seen.sigma = kRaySigma;
    seen.ray = ray + options.noise * kRaySigma * Vector2(normal(random), normal(random));
    seen.bearing = Vector3(seen.ray.x(), seen.ray.y(), 1).normalized();
    const double measured_m = (point_m.z() - options.offset_m + options.slope * kMadeUpMidM) / (1 + options.slope);
    seen.depth_sigma_m = 0.004 + 0.002 * measured_m * measured_m;
    seen.depth_m = measured_m + options.noise * seen.depth_sigma_m * normal(random);
    frame.points.push_back(seen);
    frame.descriptors.push_back(at.descriptor);
  }
  return frame;
}

}  // namespace

MadeUpWalk makeWalk(const MadeUpOptions &options) {
  Random random(options.seed);
  const std::vector<RoomPoint> room = makeRoom(&random);
  MadeUpWalk made;
  made.walk.middle_depth_m = kMadeUpMidM;
  for (uint32_t i = 0; i < options.frames; ++i) {
    made.world_from_camera.push_back(poseAt(2 * kPi * options.turns * i / options.frames));
    made.walk.keyframes.push_back(see(room, made.world_from_camera.back().inverse(), options, &random));
    made.walk.keyframes.back().index = i;
    made.walk.keyframes.back().time_ns = 500000000 * int64_t{i};
  }
  return made;
}

MadeUpWalk joined(MadeUpWalk first, const MadeUpWalk &second) {
  for (size_t i = 0; i < second.walk.keyframes.size(); ++i) {
    first.walk.keyframes.push_back(second.walk.keyframes[i]);
    first.walk.keyframes.back().index = static_cast<uint32_t>(first.walk.keyframes.size() - 1);
    first.world_from_camera.push_back(second.world_from_camera[i]);
  }
  return first;
}

Rigid stepOf(const MadeUpWalk &made, const FramePair &frames) {
  return made.world_from_camera[frames.b].inverse() * made.world_from_camera[frames.a];
}

FrameLink exactLink(const MadeUpWalk &made, const FramePair &frames, uint32_t inliers) {
  FrameLink link;
  link.frames = frames;
  link.b_from_a = stepOf(made, frames);
  link.covariance = 1e-6 * Matrix6::Identity();
  link.inliers = inliers;
  link.is_loop = isLoop(made.walk.keyframes, frames);
  return link;
}

}  // namespace sphc::host
