#include "tests/support/sensor_world.h"

#include <limits>

#include "tests/support/random_numbers.h"

namespace sphc::test {
namespace {

constexpr double kSensorFocalPx = 525;

struct Errors {
  double sideways_m, along_m;
};

Errors errorsAt(const SensorWorldOptions &options, const Vector3 &point, double depth_noise) {
  const double z = point.z(), across = options.pixel_sigma_px * z / kSensorFocalPx;
  const double sigma_z = depth_noise * (options.depth_sigma_m + options.depth_sigma_per_m2 * z * z);
  const double along = sigma_z * point.norm() / z;
  const double map2 = options.map_sigma_m * options.map_sigma_m;
  return {std::sqrt(across * across + map2), std::sqrt(along * along + map2)};
}

// What the pixel and the depth sensor make of a point; the map's error is not theirs.
Vector3 measured(const SensorWorldOptions &options, const Vector3 &point, Random *random) {
  const double z = point.z(), across = options.pixel_sigma_px * z / kSensorFocalPx;
  const double along = (options.depth_sigma_m + options.depth_sigma_per_m2 * z * z) * point.norm() / z;
  const Vector3 view = point.normalized(), noise = normalVector(random);
  const Vector3 seen = point + across * (noise - noise.dot(view) * view) + along * noise.dot(view) * view;
  const double biased_z = (seen.z() - options.bias[0] + options.bias[1] * options.mid_m) / (1 + options.bias[1]);
  return seen * (biased_z / seen.z());
}

LiftedPoint lifted(const SensorWorldOptions &options, const Vector3 &point, bool has_depth, Random *random) {
  const Vector3 seen = measured(options, point, random);
  const Errors errors = errorsAt(options, options.states_from_truth ? point : seen, options.stated_depth_noise);
  if (has_depth) return {seen, errors.sideways_m, errors.along_m};
  const double angle = errorsAt(options, point, 1).sideways_m / point.norm();
  return {seen.normalized(), angle, std::numeric_limits<double>::infinity()};
}

}  // namespace

PoseWorld makeSensorWorld(const SensorWorldOptions &options) {
  Random random(options.seed);
  const auto [points, centroid] = pointsInView(options.count, &random);

  PoseWorld world;
  world.camera_from_map = {randomRotation(&random), centroid};
  const Rigid map_from_camera = world.camera_from_map.inverse();
  for (size_t i = 0; i < options.count; ++i) {
    // even in any order, and both kinds independent of each other
    const bool is_true = random.uniform() < options.true_share;
    const bool has_depth = random.uniform() >= options.depthless_share;
    const Vector3 in_map = map_from_camera * points[i] + options.map_sigma_m * normalVector(&random);
    const Vector3 fake = randomDirection(&random);
    Correspondence c;
    c.lifted = lifted(options, points[i], has_depth, &random);
    c.direction = is_true ? in_map.normalized() : fake;
    const double quality = (is_true ? 0.4 : 0.2) + 0.15 * normal(&random);
    if (options.informative_quality) c.quality = static_cast<float>(quality);
    world.is_true.push_back(is_true);
    world.correspondences.push_back(c);
  }
  return world;
}

PosePrior odometerPrior(const PoseWorld &world, double rotation_sigma_rad, double translation_sigma_m,
                        uint64_t seed) {
  Random random(seed ^ 0x0D0ull);
  PosePrior prior;
  prior.has_pose = true;
  prior.rotation_sigma_rad = rotation_sigma_rad;
  prior.translation_sigma_m = translation_sigma_m;
  // the camera's centre and its turn err independently
  const Matrix3 turn = rotationFromVector(rotation_sigma_rad * normalVector(&random));
  Rigid map_from_camera = world.camera_from_map.inverse();
  map_from_camera.rotation = map_from_camera.rotation * turn;
  map_from_camera.translation_m += translation_sigma_m * normalVector(&random);
  prior.camera_from_map = map_from_camera.inverse();
  return prior;
}

PosePrior gravityPrior(const PoseWorld &world, double up_sigma_rad, uint64_t seed) {
  Random random(seed ^ 0x64ull);
  PosePrior prior;
  prior.has_up = true;
  prior.up_sigma_rad = up_sigma_rad;
  prior.up_map = randomDirection(&random);
  const Matrix3 turn = rotationFromVector(up_sigma_rad * normalVector(&random));
  prior.up_camera = turn * world.camera_from_map.rotation * prior.up_map;
  return prior;
}

Vector6 poseError(const Rigid &estimate, const Rigid &truth) {
  const Rigid error = truth * estimate.inverse();
  const Eigen::AngleAxisd turn(error.rotation);
  Vector6 xi;
  xi << turn.angle() * turn.axis(), error.translation_m;
  return xi;
}

}  // namespace sphc::test
