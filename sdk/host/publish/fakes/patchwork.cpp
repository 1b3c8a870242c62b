#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "host/publish/descriptor_symmetry.h"
#include "host/publish/fakes/spread_draw.h"
#include "host/publish/fakes/strategy.h"
#include "runtime/base/elementary.h"

namespace sphc::host {
namespace {

constexpr size_t kMinPatches = 60;      // with points in them; fewer would not mix
constexpr double kNarrowestRad = 0.02;  // patches are not halved below it
constexpr size_t kAlike = 8;            // patches, of nearly equal counts
constexpr double kReach = 0.8;          // of a patch's width: as far as patches that stay push each other away
constexpr double kUneven = 0.15;        // of a patch's width, so that no lattice shows

struct Patch {
  std::vector<size_t> points;
  Vector3 middle;
};

Vector3 normalVector(SecretRandom *random) {
  const double x = random->normal(), y = random->normal(), z = random->normal();
  return {x, y, z};
}

Vector3 randomDirection(SecretRandom *random) {
  Vector3 v;
  do v = normalVector(random);
  while (!(v.norm() > 1e-6));
  return v.normalized();
}

// Columns: two axes across `direction`, turned at random, and itself.
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

// The patches that have points, each of those nearest to one direction.
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
  }
  return patches;
}

// Which patches stay: apart from each other, so that no view is without any, and what one shows does not go on in
// the next.
std::vector<bool> drawReal(const std::vector<Patch> &patches, double eta, double width_rad, SecretRandom *random) {
  std::vector<Site> sites;
  for (const Patch &patch : patches) sites.push_back({patch.middle, static_cast<double>(patch.points.size())});
  return spreadDraw(sites, eta, kReach * width_rad, random);
}

// Patches of one kind, sparse ones first; those of nearly one count in random order.
std::vector<const Patch *> byCount(const std::vector<Patch> &patches, const std::vector<bool> &real, bool wanted,
                                   SecretRandom *random) {
  std::vector<const Patch *> some;
  for (size_t i = 0; i < patches.size(); ++i)
    if (real[i] == wanted) some.push_back(&patches[i]);
  const auto fewer = [](const Patch *a, const Patch *b) { return a->points.size() < b->points.size(); };
  shuffle(&some, random);
  std::stable_sort(some.begin(), some.end(), fewer);
  for (size_t begin = 0; begin < some.size(); begin += kAlike) {
    std::vector<const Patch *> alike(
        some.begin() + static_cast<std::ptrdiff_t>(begin),
        some.begin() + static_cast<std::ptrdiff_t>(std::min(begin + kAlike, some.size())));
    shuffle(&alike, random);
    std::copy(alike.begin(), alike.end(), some.begin() + static_cast<std::ptrdiff_t>(begin));
  }
  return some;
}

class PatchworkFakes : public FakeStrategy {
 public:
  explicit PatchworkFakes(double patch_deg) : width_rad_(patch_deg * kPi / 180) {}

  std::string name() const override { return "patchwork"; }

  std::vector<Assignment> assignments(const std::vector<SpherePoint> &points, size_t real_count,
                                      SecretRandom *random) const override {
    // A cloud that covers little of the sphere needs smaller patches.
    double width_rad = width_rad_;
    std::vector<Patch> patches = cut(points, width_rad, random);
    while (patches.size() < kMinPatches && width_rad > kNarrowestRad) {
      width_rad /= 2;
      patches = cut(points, width_rad, random);
    }

    const double eta = static_cast<double>(real_count) / static_cast<double>(points.size());
    const std::vector<bool> real = drawReal(patches, eta, width_rad, random);
    const std::vector<const Patch *> stay = byCount(patches, real, true, random);
    const std::vector<const Patch *> go = byCount(patches, real, false, random);
    std::vector<Assignment> assignments(points.size());
    for (const Patch *patch : stay)
      for (size_t i : patch->points) assignments[i] = {true, points[i]};
    for (size_t k = 0; k < go.size(); ++k)
      lay(points, *go[k], stay[k * stay.size() / go.size()]->middle, &assignments, random);
    return assignments;
  }

 private:
  // In mirror image, turned at random, about the middle of another patch.
  static void lay(const std::vector<SpherePoint> &points, const Patch &patch, const Vector3 &where,
                  std::vector<Assignment> *assignments, SecretRandom *random) {
    Matrix3 from = frameAt(patch.middle, random);
    from.col(0) = -from.col(0);
    const Matrix3 move = frameAt(where, random) * from.transpose();
    for (size_t i : patch.points)
      (*assignments)[i] = {false, {(move * points[i].direction).normalized(), mirrored(points[i].descriptor)}};
  }

  double width_rad_;
};

}  // namespace

std::unique_ptr<FakeStrategy> patchworkFakes(double patch_deg) {
  if (!(patch_deg >= 2 && patch_deg <= 60))
    throw std::runtime_error("patches are " + std::to_string(patch_deg) + " degrees wide; it must be 2 to 60");
  return std::make_unique<PatchworkFakes>(patch_deg);
}

}  // namespace sphc::host
