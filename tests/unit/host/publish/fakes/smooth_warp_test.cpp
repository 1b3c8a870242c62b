#include "host/publish/fakes/smooth_warp.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <vector>

#include "runtime/base/elementary.h"
#include "tests/support/random_numbers.h"

namespace sphc::host {
namespace {

constexpr double kDegree = kPi / 180;
constexpr double kStrength = 0.8 * kDegree, kReach = 2.2 * kDegree, kWidth = 8 * kDegree;

SmoothWarp warp(uint8_t key) {
  SecretRandom random({key});
  return {kStrength, kReach, &random};
}

// Of a patch about z.
std::vector<Vector3> patchOf(size_t count, uint64_t seed) {
  Random random(seed);
  std::vector<Vector3> directions;
  for (size_t i = 0; i < count; ++i)
    directions.push_back(
        Vector3(kWidth * (random.uniform() - 0.5), kWidth * (random.uniform() - 0.5), 1).normalized());
  return directions;
}

double angle(const Vector3 &a, const Vector3 &b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

TEST(SmoothWarp, IsAsStrongAsItIsTold) {
  double sum2 = 0;
  for (uint8_t key = 0; key < 100; ++key)
    for (const Vector3 &direction : patchOf(20, key))
      sum2 += std::pow(angle(warp(key)(direction), direction), 2) / 2000;
  EXPECT_NEAR(std::sqrt(sum2), std::sqrt(2.0) * kStrength, 0.1 * kStrength);
}

TEST(SmoothWarp, WhatLiesTogetherKeepsItsDistances) {
  Random random(3);
  double worst = 0;
  for (uint8_t key = 0; key < 50; ++key) {
    const SmoothWarp bent = warp(key);
    for (const Vector3 &direction : patchOf(20, key)) {
      const Vector3 beside = (direction + 0.002 * test::normalVector(&random)).normalized();
      worst = std::max(worst, std::abs(angle(bent(direction), bent(beside)) / angle(direction, beside) - 1));
    }
    EXPECT_EQ(bent(Vector3::UnitZ()), bent(Vector3::UnitZ()));
  }
  EXPECT_LT(worst, 2);  // stretched, never torn
}

// What a camera can do to a flat patch, wherever it stands, is a homography.
TEST(SmoothWarp, NoViewOfAFlatPatchExplainsIt) {
  size_t agree = 0, points = 0;
  for (uint8_t key = 0; key < 30; ++key) {
    const SmoothWarp bent = warp(key);
    const std::vector<Vector3> patch = patchOf(60, key);
    Eigen::MatrixXd equations(2 * patch.size(), 8);
    Eigen::VectorXd values(2 * patch.size());
    for (size_t i = 0; i < patch.size(); ++i) {
      const Vector3 moved = bent(patch[i]);
      const double x = patch[i].x() / patch[i].z(), y = patch[i].y() / patch[i].z(), u = moved.x() / moved.z(),
                   v = moved.y() / moved.z();
      const auto row = static_cast<Eigen::Index>(2 * i);
      equations.row(row) << x, y, 1, 0, 0, 0, -u * x, -u * y;
      equations.row(row + 1) << 0, 0, 0, x, y, 1, -v * x, -v * y;
      values[row] = u;
      values[row + 1] = v;
    }
    const Eigen::VectorXd off = equations * equations.colPivHouseholderQr().solve(values) - values;
    for (size_t i = 0; i < patch.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(2 * i);
      agree += std::hypot(off[row], off[row + 1]) < 0.3 * kDegree;
      ++points;
    }
  }
  EXPECT_LT(static_cast<double>(agree) / static_cast<double>(points), 0.5);
}

}  // namespace
}  // namespace sphc::host
