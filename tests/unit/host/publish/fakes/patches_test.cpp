#include "host/publish/fakes/patches.h"

#include <gtest/gtest.h>

#include <cmath>

#include "runtime/base/elementary.h"
#include "tests/support/random_numbers.h"

namespace sphc::host {
namespace {

constexpr double kWidthRad = 8 * kPi / 180;

std::vector<SpherePoint> pointsToCut(size_t count, double spread) {
  Random random(4);
  std::vector<SpherePoint> points;
  for (size_t i = 0; i < count; ++i)
    points.push_back({(Vector3(1, 0.3, 0) + spread * test::normalVector(&random)).normalized(), {}});
  return points;
}

std::vector<Patch> patchesOf(const std::vector<SpherePoint> &points, double *width_rad, uint8_t key = 1) {
  SecretRandom random({key});
  return cutIntoPatches(points, width_rad, &random);
}

TEST(Patches, HaveEveryPointOnceAndAreAsWideAsAskedFor) {
  const auto points = pointsToCut(5000, 2);
  double width_rad = kWidthRad, farthest = 0;
  const auto patches = patchesOf(points, &width_rad);
  EXPECT_EQ(width_rad, kWidthRad);
  std::vector<int> times(points.size());
  for (const Patch &patch : patches) {
    EXPECT_NEAR(patch.middle.norm(), 1, 1e-12);
    for (size_t i : patch.points) {
      ++times[i];
      farthest = std::max(farthest, (points[i].direction - patch.middle).norm());
    }
  }
  for (int t : times) EXPECT_EQ(t, 1);
  EXPECT_LT(farthest, 1.5 * kWidthRad);
  EXPECT_NEAR(static_cast<double>(patches.size()), 4 * kPi / (kWidthRad * kWidthRad), 60);
}

TEST(Patches, OfASmallCloudAreNarrower) {
  double width_rad = kWidthRad;
  EXPECT_GE(patchesOf(pointsToCut(5000, 0.1), &width_rad).size(), 60u);
  EXPECT_EQ(width_rad, kWidthRad / 2);
}

TEST(Patches, TheKeyDecides) {
  const auto points = pointsToCut(1000, 2);
  double width_rad = kWidthRad;
  const auto a = patchesOf(points, &width_rad), b = patchesOf(points, &width_rad),
             c = patchesOf(points, &width_rad, 2);
  EXPECT_EQ(a[0].points, b[0].points);
  EXPECT_NE(a[0].points, c[0].points);
}

TEST(Patches, FramesAreRotationsAboutTheDirection) {
  SecretRandom random({1});
  const Vector3 direction = Vector3(1, 2, 3).normalized();
  const Matrix3 frame = frameAt(direction, &random), other = frameAt(direction, &random);
  EXPECT_LT((frame.transpose() * frame - Matrix3::Identity()).norm(), 1e-12);
  EXPECT_GT(frame.col(0).cross(frame.col(1)).dot(direction), 0.999);
  EXPECT_GT((frame - other).norm(), 0.01);
}

}  // namespace
}  // namespace sphc::host
