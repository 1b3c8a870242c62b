#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "host/publish/fakes/strategy.h"
#include "tests/support/random_numbers.h"

namespace sphc::host {
namespace {

// Directions of `count` fakes beside the real ones.
std::vector<Vector3> fakesOf(double variance, const std::vector<Vector3> &real, size_t count,
                             SecretRandom *random) {
  std::vector<SpherePoint> points;
  for (const Vector3 &direction : real) points.push_back({direction, {}});
  for (size_t i = 0; i < count; ++i) points.push_back({Vector3(0, 0, -1), {}});  // where a fake was says nothing
  std::vector<Vector3> fakes;
  for (const Assignment &assignment : gaussianFakes(variance)->assignments(points, real.size(), random)) {
    if (!assignment.real) fakes.push_back(assignment.shown.direction);
  }
  return fakes;
}

// Algorithm 1: a fake is a real direction plus Gaussian noise of variance sigma^2 on each coordinate, projected.
TEST(GaussianFakes, FakesSpreadAroundRealDirectionsWithSigma) {
  SecretRandom random({5});
  const Vector3 base(0, 0.6, 0.8);
  constexpr size_t kFakes = 40000;
  double expected_mean = 0, expected_square = 0;
  Random reference(8);
  for (size_t i = 0; i < kFakes; ++i) {
    const double dot = (base + std::sqrt(0.1) * test::normalVector(&reference)).normalized().dot(base);
    expected_mean += dot / kFakes, expected_square += dot * dot / kFakes;
  }
  double mean = 0, square = 0;
  const std::vector<Vector3> fakes = fakesOf(0.1, {base}, kFakes, &random);
  ASSERT_EQ(fakes.size(), kFakes);
  Vector3 sum = Vector3::Zero();
  for (const Vector3 &fake : fakes) {
    const double dot = fake.dot(base);
    mean += dot / kFakes, square += dot * dot / kFakes;
    sum += fake / kFakes;
  }
  EXPECT_NEAR(mean, expected_mean, 0.003);
  EXPECT_NEAR(square, expected_square, 0.003);
  EXPECT_LT((sum.normalized() - base).norm(), 0.01);  // no side is preferred
  // for small noise the tangential variance is sigma^2 itself
  double tangential = 0;
  for (const Vector3 &fake : fakesOf(1e-4, {base}, kFakes, &random))
    tangential += (fake - base).squaredNorm() / 2 / kFakes;
  EXPECT_NEAR(tangential, 1e-4, 3e-6);
}

TEST(GaussianFakes, EveryRealDirectionBearsAsManyFakes) {
  SecretRandom random({6});
  const std::vector<Vector3> real = {Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ()};
  int count[3] = {};
  for (const Vector3 &fake : fakesOf(1e-6, real, 300, &random))
    for (int k = 0; k < 3; ++k) count[k] += fake.dot(real[static_cast<size_t>(k)]) > 0.9;
  for (int c : count) EXPECT_EQ(c, 100);
}

TEST(GaussianFakes, BadVariancesAreExplained) {
  EXPECT_THROW(gaussianFakes(-1), std::runtime_error);
  EXPECT_THROW(gaussianFakes(std::nan("")), std::runtime_error);
}

}  // namespace
}  // namespace sphc::host
