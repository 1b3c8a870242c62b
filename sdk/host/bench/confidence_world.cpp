// The made-up worlds of confidence_case.h.
#include <algorithm>
#include <cmath>

#include "host/bench/confidence_case.h"
#include "host/bench/normal.h"
#include "host/bench/pose_ours.h"

namespace sphc::host {
namespace {

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

// How far along the ray the walls of a box around the origin are, or a cupboard that stands before them.
double depthOfRoom(const World &world, const Vector3 &half_m, const Vector3 &ray, Random *random) {
  const Rigid map_from_camera = world.camera_from_map.inverse();
  const Vector3 d = map_from_camera.rotation * ray;
  double nearest = 1e9;
  for (int axis = 0; axis < 3; ++axis) {
    const double wall = d[axis] > 0 ? half_m[axis] : -half_m[axis];
    if (std::abs(d[axis]) > 1e-9)
      nearest = std::min(nearest, (wall - map_from_camera.translation_m[axis]) / d[axis]);
  }
  return random->uniform() < 0.3 ? nearest * uniformIn(random, 0.5, 1) : nearest;
}

void addRow(const World &world, const Vector2 &pixel_px, double z_m, const CaseNoise &noise, Random *random,
            PoseCase *c) {
  const LiftedPoint exact = liftPixel(world.camera, pixel_px, z_m, noise);
  const Vector3 point_map_m = world.camera_from_map.inverse() * exact.point_m;
  const Vector3 built_m = point_map_m + noise.map_sigma_m * normalVector(random);
  const Vector2 seen_px = pixel_px + noise.pixel_sigma_px * normalVector(random).head<2>();
  const double sigma_m = noise.depth_sigma_m + noise.depth_sigma_per_m2 * z_m * z_m;
  const double measured_m = z_m - world.depth.correctionAt(z_m) + sigma_m * normalOf(random);
  c->correspondences.push_back({liftPixel(world.camera, seen_px, measured_m, noise), built_m.normalized()});
  c->is_true.push_back(true);
}

World drawWorld(Random *random) {
  World world;
  world.depth = sensorPrior(DepthSource::kTof);
  for (int i = 0; i < 2; ++i) world.depth.mean[i] = std::sqrt(world.depth.covariance(i, i)) * normalOf(random);
  return world;
}

void fillRoom(const CaseNoise &noise, Random *random, PoseCase *c) {
  World world = drawWorld(random);
  world.camera = {525, 525, 320, 240, 640, 480};
  const Vector3 half_m(uniformIn(random, 1.5, 2.6), uniformIn(random, 1.2, 2.2), 1.25);
  const double x = uniformIn(random, -0.5, 0.5), y = uniformIn(random, -0.5, 0.5), z = uniformIn(random, -0.5, 0.5);
  world.camera_from_map = poseLookingAnywhere(half_m.cwiseProduct(Vector3(x, y, z)), random);
  const size_t count = 150 + random->below(400);
  for (int tries = 0; tries < 20000 && c->correspondences.size() < count; ++tries) {
    const double u = uniformIn(random, 0, 640), v = uniformIn(random, 0, 480);
    const Vector3 ray((u - 320) / 525, (v - 240) / 525, 1);
    const double depth_m = depthOfRoom(world, half_m, ray, random);
    if (depth_m > 0.4 && depth_m < 4.5) addRow(world, {u, v}, depth_m, noise, random, c);
  }
  c->camera = world.camera;
  c->truth_camera_from_map = world.camera_from_map;
}

// Keypoints crowd on a few objects, each at its own depth.
void fillObjects(const CaseNoise &noise, Random *random, PoseCase *c) {
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
}

}  // namespace

const char *worldName(MadeWorld world) { return world == MadeWorld::kRoom ? "made room" : "made objects"; }

PoseCase madeCase(MadeWorld world, uint64_t seed, const CaseNoise &noise) {
  Random random(seed);
  PoseCase c;
  c.name = worldName(world);
  c.eta_percent = 100;
  if (world == MadeWorld::kRoom)
    fillRoom(noise, &random, &c);
  else
    fillObjects(noise, &random, &c);
  return c;
}

}  // namespace sphc::host
