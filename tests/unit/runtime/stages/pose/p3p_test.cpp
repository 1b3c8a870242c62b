#include "runtime/stages/pose/p3p.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/random_numbers.h"

namespace sphc {
namespace {

double error(const Rigid &a, const Rigid &b) {
  return (a.rotation - b.rotation).norm() + (a.translation_m - b.translation_m).norm();
}

struct P3pProblem {
  Vector3 bearing[3], point[3];
  Rigid truth;
};

// Rays leave the map's centre, points are those the camera sees.
P3pProblem randomP3p(Random *random) {
  P3pProblem p;
  p.truth = {test::randomRotation(random), 2 * test::normalVector(random)};
  for (int i = 0; i < 3; ++i) {
    const double x = test::normal(random), y = test::normal(random);
    const double z = test::uniformIn(random, 0.5, 5);
    p.point[i] = Vector3(0.6 * x * z, 0.6 * y * z, z);
    p.bearing[i] = (p.truth * p.point[i]).normalized();
  }
  return p;
}

double triangleArea(const P3pProblem &p) {
  return 0.5 * (p.point[1] - p.point[0]).cross(p.point[2] - p.point[0]).norm();
}

TEST(P3p, FindsTheTruthInEveryRandomProblem) {
  Random random(1);
  int missed = 0, tried = 0, solutions = 0;
  double worst = 0;
  while (tried < 100000) {
    const P3pProblem p = randomP3p(&random);
    if (triangleArea(p) < 1e-2) continue;  // on a line: excluded by the contract
    ++tried;
    const FixedVector<Rigid, 4> poses = solveP3p(p.bearing, p.point);
    solutions += static_cast<int>(poses.size());
    double best = 1e9;
    for (const Rigid &pose : poses) best = std::min(best, error(pose, p.truth));
    if (best > 1e-3)
      ++missed;
    else
      worst = std::max(worst, best);
  }
  EXPECT_EQ(missed, 0) << "of " << tried;
  EXPECT_LT(worst, 1e-3);
  EXPECT_LT(solutions, 2.5 * tried);
}

TEST(P3p, EverySolutionSolves) {
  Random random(2);
  for (int i = 0; i < 5000; ++i) {
    const P3pProblem p = randomP3p(&random);
    if (triangleArea(p) < 1e-2) continue;
    for (const Rigid &pose : solveP3p(p.bearing, p.point)) {
      EXPECT_NEAR(pose.rotation.determinant(), 1, 1e-9);
      EXPECT_LT((pose.rotation * pose.rotation.transpose() - Matrix3::Identity()).norm(), 1e-9);
      for (int k = 0; k < 3; ++k) EXPECT_LT(((pose * p.point[k]).normalized() - p.bearing[k]).norm(), 1e-5);
    }
  }
}

void expectSane(const Vector3 bearing[3], const Vector3 point[3]) {
  const FixedVector<Rigid, 4> poses = solveP3p(bearing, point);
  EXPECT_LE(poses.size(), 4u);
  for (const Rigid &pose : poses) {
    EXPECT_TRUE(isFinite(pose.rotation.sum()));
    EXPECT_TRUE(isFinite(pose.translation_m.sum()));
  }
}

TEST(P3p, DegenerateInputIsHarmless) {
  Random random(3);
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 2000; ++i) {
    P3pProblem p = randomP3p(&random);
    const P3pProblem good = p;
    p.point[1] = p.point[0];  // one point twice
    expectSane(p.bearing, p.point);
    p = good, p.bearing[1] = p.bearing[0];
    expectSane(p.bearing, p.point);
    p = good, p.bearing[2] = p.bearing[1] = p.bearing[0];
    expectSane(p.bearing, p.point);
    p = good, p.point[2] = 0.3 * p.point[0] + 0.7 * p.point[1];  // on a line
    expectSane(p.bearing, p.point);
    p = good, p.point[0] = p.point[1] = p.point[2] = Vector3::Zero();
    expectSane(p.bearing, p.point);
    p = good, p.bearing[0] = Vector3::Zero();
    expectSane(p.bearing, p.point);
    p = good, p.bearing[0] = -p.bearing[1];  // opposite rays
    expectSane(p.bearing, p.point);
    p = good, p.point[i % 3][i % 2] = i % 2 ? nan : inf;
    expectSane(p.bearing, p.point);
    p = good, p.bearing[i % 3][i % 2] = nan;
    expectSane(p.bearing, p.point);
    for (Vector3 &point : p.point) point = 1e-200 * good.point[0];
    expectSane(good.bearing, p.point);
  }
}

TEST(P3p, FakeDirectionsSeldomFitAnything) {  // the number of solutions is bounded anyhow
  Random random(4);
  for (int i = 0; i < 2000; ++i) {
    P3pProblem p = randomP3p(&random);
    for (Vector3 &bearing : p.bearing) bearing = test::randomDirection(&random);
    expectSane(p.bearing, p.point);
  }
}

}  // namespace
}  // namespace sphc
