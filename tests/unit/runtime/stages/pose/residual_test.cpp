#include "runtime/stages/pose/residual.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/pose_world.h"
#include "tests/support/random_numbers.h"

namespace sphc {
namespace {

TEST(Corrected, APointLiesWhereASensorWithoutBiasHasIt) {
  DepthCalibration depth;
  depth.mid_m = 2;
  depth.mean = {0.01, -0.04};
  depth.noise_scale = 1.5;
  const LiftedPoint measured = {Vector3(0.5, 0.2, 4), 0.005, 0.02};
  const LiftedPoint point = corrected(measured, depth);
  EXPECT_NEAR(point.point_m.z(), 4 + 0.01 - 0.04 * 2, 1e-12);
  EXPECT_LT(point.point_m.normalized().cross(measured.point_m.normalized()).norm(), 1e-12);
  EXPECT_EQ(point.sideways_m, 0.005);
  EXPECT_EQ(point.along_m, 0.03);
  const LiftedPoint ray = {Vector3(0.1, 0, 1), 0.005, std::numeric_limits<double>::infinity()};
  EXPECT_EQ(corrected(ray, depth).point_m, ray.point_m);
}

TEST(Residual, IsZeroAtTheTruth) {
  const test::PoseWorld world = test::makePoseWorld({});
  for (const Correspondence &c : world.correspondences) {
    const Residual r = residualOf(c, world.camera_from_map);
    EXPECT_LT(r.squared, 1e-18);
    EXPECT_TRUE(r.in_front);
    EXPECT_LT((r.foot_m - c.lifted.point_m).norm(), 1e-10);
  }
}

TEST(Residual, NoOtherPointOfTheRayIsNearerInItsMetric) {
  Random random(2);
  for (int i = 0; i < 500; ++i) {
    Correspondence c = {{test::normalVector(&random) + Vector3(0, 0, 3), 0.01, 0.05},
                        test::randomDirection(&random)};
    const Rigid pose = {test::randomRotation(&random), test::normalVector(&random)};
    const Residual r = residualOf(c, pose);
    const Vector3 view = c.lifted.point_m.normalized(), ray = pose.rotation * c.direction;
    for (double step : {-0.1, -1e-3, 1e-3, 0.1}) {
      const Vector3 off = whiten(c.lifted, view, c.lifted.point_m - (r.foot_m + step * ray));
      EXPECT_GE(off.squaredNorm(), r.squared);
    }
  }
}

TEST(Residual, IsChiSquaredWithTwoDegreesWhenTheErrorsAreAsStated) {
  Random random(3);
  double sum = 0, beyond = 0;
  constexpr int kTrials = 40000;
  for (int i = 0; i < kTrials; ++i) {
    const Vector3 point(0.5 * test::normal(&random), 0.5 * test::normal(&random), 2);
    const Rigid pose = {test::randomRotation(&random), test::normalVector(&random)};
    const Vector3 view = point.normalized();
    const double sideways = 0.004, along = 0.015;
    const Vector3 noise = test::normalVector(&random);
    Correspondence c;
    c.direction = (pose.inverse() * point).normalized();
    c.lifted = {point + sideways * noise + (along - sideways) * view.dot(noise) * view, sideways, along};
    const double squared = residualOf(c, pose).squared;
    sum += squared;
    beyond += squared > 12;
  }
  EXPECT_NEAR(sum / kTrials, 2, 0.05);
  EXPECT_NEAR(beyond / kTrials, std::exp(-6), 0.001);  // P(chi2_2 > 12)
}

// The paper's case: a point on the ray's backward extension fits a line, not a ray.
TEST(Residual, CheiralityTellsForwardFromBackward) {
  const test::PoseWorld world = test::makePoseWorld({});
  for (Correspondence c : world.correspondences) {
    c.direction = -c.direction;
    const Residual r = residualOf(c, world.camera_from_map);
    EXPECT_LT(r.squared, 1e-18);  // on the line it is perfect
    EXPECT_FALSE(r.in_front);
  }
}

}  // namespace
}  // namespace sphc
