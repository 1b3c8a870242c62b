#include "tests/support/pose_world.h"

#include <cmath>

#include "tests/support/random_numbers.h"

namespace sphc::test {
namespace {

constexpr double kFocalPx = 525, kHalfWidth = 0.6, kHalfHeight = 0.45, kNearM = 0.6, kFarM = 4;

// Evenly spread over the cone.
Vector3 directionNear(const Vector3 &axis, double cone_rad, Random *random) {
  const Vector3 any = randomDirection(random);
  if (cone_rad >= kPi) return any;
  const double cosine = 1 - (1 - std::cos(cone_rad)) * random->uniform();
  const Vector3 across = (any - any.dot(axis) * axis).normalized();
  return cosine * axis + std::sqrt(1 - cosine * cosine) * across;
}

Vector3 measured(const Vector3 &point, const PoseWorldOptions &options, Random *random) {
  const double across = options.pixel_sigma_px * point.z() / kFocalPx;
  const double dx = normal(random), dy = normal(random), along = normal(random);
  const Vector3 view = point.normalized();
  return point + across * Vector3(dx, dy, 0) + options.depth_sigma_m * along * view;
}

}  // namespace

Vector3 pointInView(Random *random) {
  const double z = uniformIn(random, kNearM, kFarM);
  const double x = uniformIn(random, -kHalfWidth, kHalfWidth), y = uniformIn(random, -kHalfHeight, kHalfHeight);
  return {x * z, y * z, z};
}

ViewedPoints pointsInView(size_t count, Random *random, double wall_m) {
  ViewedPoints viewed;
  for (size_t i = 0; i < count; ++i) {
    const Vector3 point = pointInView(random);
    viewed.points_m.push_back(wall_m == 0 ? point : Vector3(wall_m / point.z() * point));
  }
  for (const Vector3 &point : viewed.points_m) viewed.centroid_m += point / static_cast<double>(count);
  return viewed;
}

PoseWorld makePoseWorld(const PoseWorldOptions &options) {
  Random random(options.seed);
  const auto [points, centroid] = pointsInView(options.count, &random, options.wall_m);

  PoseWorld world;
  world.camera_from_map.rotation = randomRotation(&random);
  world.camera_from_map.translation_m = centroid + options.centre_offset_m;
  const Rigid map_from_camera = world.camera_from_map.inverse();
  const size_t true_count = static_cast<size_t>(options.true_share * static_cast<double>(options.count) + 0.5);
  for (size_t i = 0; i < options.count; ++i) {
    Correspondence c;
    c.lifted = {measured(points[i], options, &random), options.stated_sideways_m, options.stated_depth_sigma_m};
    const Vector3 exact = (map_from_camera * points[i]).normalized();
    const Vector3 fake = directionNear(exact, options.cone_rad, &random);
    world.is_true.push_back(i < true_count);
    c.direction = i < true_count ? exact : fake;
    world.correspondences.push_back(c);
  }
  return world;
}

double rotationErrorRad(const Rigid &estimate, const Rigid &truth) {
  return rotationAngle(estimate.rotation.transpose() * truth.rotation);
}
double translationErrorM(const Rigid &estimate, const Rigid &truth) {
  return (estimate.inverse().translation_m - truth.inverse().translation_m).norm();
}

}  // namespace sphc::test
