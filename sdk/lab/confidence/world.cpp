// The made-up worlds of confidence_case.h.
#include <algorithm>
#include <cmath>

#include "lab/common/normal.h"
#include "lab/confidence/case.h"
#include "lab/pose/ours.h"

namespace sphc::host {
namespace {

constexpr double kCalibrated = 5;  // times better known

struct World {
  PinholeCamera camera;
  Rigid camera_from_map;
  DepthCalibration depth;  // how the sensor is off, drawn from what is believed of it
};

double uniformIn(Random *random, double low, double high) { return low + (high - low) * random->uniform(); }

Rigid poseLookingAnywhere(const Vector3 &centre_map_m, Random *random) {
  Rigid pose;  // camera_from_map
  double q[4];
  for (double &part : q) part = normalOf(random);
  pose.rotation = rotationFromQuaternion(q);  // normalises
  pose.translation_m = -(pose.rotation * centre_map_m);
  return pose;
}

// Where keypoints are in an image of 640 x 480: anywhere, or around some pictures on the walls.
class Texture {
 public:
  explicit Texture(Random *random) : spots_px_(random->below(2) * (2 + random->below(8))) {
    for (Vector2 &spot_px : spots_px_) spot_px = anywhere(random);
  }
  Vector2 draw(Random *random) const {
    if (spots_px_.empty() || random->uniform() < 0.1) return anywhere(random);
    const Vector2 &spot_px = spots_px_[random->below(static_cast<uint32_t>(spots_px_.size()))];
    return inside(spot_px + 60 * normalVector(random).head<2>());
  }

 private:
  static Vector2 anywhere(Random *random) {
    const double u = uniformIn(random, 0, 640), v = uniformIn(random, 0, 480);
    return {u, v};
  }
  static Vector2 inside(const Vector2 &pixel_px) {
    return {std::clamp(pixel_px.x(), 0.0, 640.0), std::clamp(pixel_px.y(), 0.0, 480.0)};
  }
  std::vector<Vector2> spots_px_;
};

struct Box {
  Vector3 centre_m, half_m;  // map frame: the sphere centre stands anywhere in it
};

Vector3 placeIn(const Box &box, Random *random) {
  const double x = uniformIn(random, -0.8, 0.8), y = uniformIn(random, -0.8, 0.8), z = uniformIn(random, -0.8, 0.8);
  return box.centre_m + box.half_m.cwiseProduct(Vector3(x, y, z));
}

Box drawRoom(Random *random) {
  Box room = {Vector3::Zero(), {uniformIn(random, 1.2, 3), 0, 1.25}};
  room.half_m.y() = uniformIn(random, 1.2, 3);
  room.centre_m = -placeIn(room, random);
  return room;
}

// How far along the ray the walls of the room are, or a cupboard that stands before them.
double depthOfRoom(const World &world, const Box &room, const Vector3 &ray, Random *random) {
  const Rigid map_from_camera = world.camera_from_map.inverse();
  const Vector3 d = map_from_camera.rotation * ray, from_m = map_from_camera.translation_m - room.centre_m;
  double nearest_m = 1e9;
  for (int axis = 0; axis < 3; ++axis) {
    const double wall_m = d[axis] > 0 ? room.half_m[axis] : -room.half_m[axis];
    if (std::abs(d[axis]) > 1e-9) nearest_m = std::min(nearest_m, (wall_m - from_m[axis]) / d[axis]);
  }
  return random->uniform() < 0.3 ? nearest_m * uniformIn(random, 0.5, 1) : nearest_m;
}

void addRow(const World &world, const Vector2 &pixel_px, double z_m, const CaseNoise &noise, Random *random,
            PoseCase *c) {
  const LiftedPoint exact = liftPixel(world.camera, pixel_px, z_m, noise);
  const Vector3 point_map_m = world.camera_from_map.inverse() * exact.point_m;
  const Vector3 built_m = point_map_m + noise.map_sigma_m * normalVector(random);
  const Vector2 seen_px = pixel_px + noise.pixel_sigma_px * normalVector(random).head<2>();
  const double stated_m = noise.depth_sigma_m + noise.depth_sigma_per_m2 * z_m * z_m;
  const double measured_m =
      z_m - world.depth.correctionAt(z_m) + world.depth.noise_scale * stated_m * normalOf(random);
  c->correspondences.push_back({liftPixel(world.camera, seen_px, measured_m, noise), built_m.normalized()});
  c->is_true.push_back(true);
}

World drawWorld(Random *random) {
  World world;
  world.depth = sensorPrior(DepthSource::kTof);
  for (int i = 0; i < 2; ++i) world.depth.mean[i] = std::sqrt(world.depth.covariance(i, i)) * normalOf(random);
  world.depth.noise_scale = uniformIn(random, 0.3, 1.2);
  return world;
}

// What a calibration finds of the bias.
DepthCalibration calibrated(const DepthCalibration &bias, Random *random) {
  DepthCalibration found = bias;
  for (int i = 0; i < 2; ++i) found.mean[i] += std::sqrt(bias.covariance(i, i)) / kCalibrated * normalOf(random);
  found.covariance /= kCalibrated * kCalibrated;
  return found;
}

DepthCalibration fillRoom(const CaseNoise &noise, Random *random, PoseCase *c) {
  World world = drawWorld(random);
  const double focal_px = uniformIn(random, 280, 620);
  world.camera = {focal_px, focal_px, 320, 240, 640, 480};
  const Box room = drawRoom(random);
  world.camera_from_map = poseLookingAnywhere(placeIn(room, random), random);
  const Texture texture(random);
  const size_t count = 150 + random->below(400);
  for (int tries = 0; tries < 20000 && c->correspondences.size() < count; ++tries) {
    const Vector2 pixel_px = texture.draw(random);
    const Vector3 ray((pixel_px.x() - 320) / focal_px, (pixel_px.y() - 240) / focal_px, 1);
    const double depth_m = depthOfRoom(world, room, ray, random);
    if (depth_m > 0.4 && depth_m < 4.5) addRow(world, pixel_px, depth_m, noise, random, c);
  }
  c->camera = world.camera;
  c->truth_camera_from_map = world.camera_from_map;
  return world.depth;
}

// Keypoints crowd on a few objects, each at its own depth.
DepthCalibration fillObjects(const CaseNoise &noise, Random *random, PoseCase *c) {
  World world = drawWorld(random);
  world.camera = {290, 290, 212, 120, 424, 240};
  const double far_m = uniformIn(random, 1, 4);
  world.camera_from_map = poseLookingAnywhere(normalVector(random).normalized() * far_m, random);
  const size_t objects = 3 + random->below(8), count = 100 + random->below(300);
  while (c->correspondences.size() < count) {
    const double u = uniformIn(random, 20, 404), v = uniformIn(random, 20, 220);
    const double depth_m = uniformIn(random, 0.6, 3.5), size_px = uniformIn(random, 15, 70);
    for (size_t i = 0; i < count / objects; ++i) {
      const double du = size_px * normalOf(random), dv = size_px * normalOf(random);
      const double row_depth_m = std::max(0.4, depth_m + 0.05 * depth_m * normalOf(random));
      if (u + du > 0 && u + du < 424 && v + dv > 0 && v + dv < 240)
        addRow(world, {u + du, v + dv}, row_depth_m, noise, random, c);
    }
  }
  c->camera = world.camera;
  c->truth_camera_from_map = world.camera_from_map;
  return world.depth;
}

}  // namespace

const char *worldName(MadeWorld world) { return world == MadeWorld::kRoom ? "made room" : "made objects"; }

ConfidenceQuery madeQuery(MadeWorld world, uint64_t seed, const CaseNoise &noise) {
  Random random(seed);
  ConfidenceQuery query;
  query.pose_case.name = worldName(world);
  query.pose_case.eta_percent = 100;
  const auto fill = world == MadeWorld::kRoom ? fillRoom : fillObjects;
  const DepthCalibration bias = fill(noise, &random, &query.pose_case);
  query.depth = seed % 2 == 0 ? calibrated(bias, &random) : sensorPrior(DepthSource::kTof);
  return query;
}

}  // namespace sphc::host
