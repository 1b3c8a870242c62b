#include "host/publish/fakes/patches.h"

#include <algorithm>
#include <cmath>

#include "runtime/base/elementary.h"

namespace sphc::host {
namespace {

constexpr size_t kMinPatches = 60;      // with points in them; fewer would not mix
constexpr double kNarrowestRad = 0.02;  // patches are not halved below it
constexpr double kUneven = 0.15;        // of a patch's width, so that no lattice shows

Vector3 randomDirection(SecretRandom *random) {
  Vector3 v;
  do v = normalVector(random);
  while (!(v.norm() > 1e-6));
  return v.normalized();
}

// Directions about `width_rad` apart all over the sphere: a golden spiral, jittered and turned.
std::vector<Vector3> spreadDirections(double width_rad, SecretRandom *random) {
  const size_t count = static_cast<size_t>(std::ceil(4 * kPi / (width_rad * width_rad)));
  const Matrix3 turn = frameAt(randomDirection(random), random);
  std::vector<Vector3> directions;
  directions.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(count);
    const double radius = std::sqrt(1 - z * z), angle = kPi * (1 + std::sqrt(5)) * static_cast<double>(i);
    const Vector3 even(radius * std::cos(angle), radius * std::sin(angle), z);
    directions.push_back(turn * (even + kUneven * width_rad * normalVector(random)).normalized());
  }
  return directions;
}

std::vector<Patch> cut(const std::vector<SpherePoint> &points, double width_rad, SecretRandom *random) {
  const std::vector<Vector3> seeds = spreadDirections(width_rad, random);
  Eigen::Matrix<double, Eigen::Dynamic, 3> rows(seeds.size(), 3);
  for (size_t i = 0; i < seeds.size(); ++i) rows.row(static_cast<Eigen::Index>(i)) = seeds[i];
  std::vector<Patch> patches(seeds.size());
  for (size_t i = 0; i < points.size(); ++i) {
    Eigen::Index nearest = 0;
    (rows * points[i].direction).maxCoeff(&nearest);
    patches[static_cast<size_t>(nearest)].points.push_back(i);
  }
  patches.erase(std::remove_if(patches.begin(), patches.end(), [](const Patch &p) { return p.points.empty(); }),
                patches.end());
  for (Patch &patch : patches) {
    Vector3 sum = Vector3::Zero();
    for (size_t i : patch.points) sum += points[i].direction;
    patch.middle = sum.normalized();
    patch.number = static_cast<uint32_t>(&patch - patches.data());
  }
  return patches;
}

}  // namespace

Vector3 normalVector(SecretRandom *random) {
  const double x = random->normal(), y = random->normal(), z = random->normal();
  return {x, y, z};
}

Matrix3 frameAt(const Vector3 &direction, SecretRandom *random) {
  Vector3 across;
  do across = direction.cross(randomDirection(random));
  while (!(across.norm() > 1e-3));
  Matrix3 frame;
  frame.col(0) = across.normalized();
  frame.col(1) = direction.cross(frame.col(0));
  frame.col(2) = direction;
  return frame;
}

std::vector<Patch> cutIntoPatches(const std::vector<SpherePoint> &points, double *width_rad, SecretRandom *random) {
  std::vector<Patch> patches = cut(points, *width_rad, random);
  while (patches.size() < kMinPatches && *width_rad > kNarrowestRad) {
    *width_rad /= 2;
    patches = cut(points, *width_rad, random);
  }
  return patches;
}

}  // namespace sphc::host
