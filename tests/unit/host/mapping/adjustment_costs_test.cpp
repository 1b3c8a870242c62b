#include "host/mapping/adjustment_costs.h"

#include <gtest/gtest.h>

#include "expect_derivatives.h"

namespace sphc::host {
namespace {

constexpr double kMidM = 2.5;

const Rigid kCameraFromWorld = {rotationFromVector(Vector3(0.2, -0.4, 0.1)), Vector3(0.3, -0.2, 0.5)};

// Where residuals are not zero.
SeenPoint somePoint() {
  SeenPoint seen;
  seen.ray = {0.2, -0.3};
  seen.sigma = 0.0016;
  seen.depth_m = 2.1;
  seen.depth_sigma_m = 0.012;
  seen.bearing = Vector3(0.2, -0.3, 1).normalized();
  seen.depth_by_move = Vector3(0.3, -0.2, 1.1);
  return seen;
}

Numbers pointInWorld(const Vector3 &in_camera_m) {
  const Vector3 point_m = kCameraFromWorld.inverse() * in_camera_m;
  return {point_m.x(), point_m.y(), point_m.z()};
}

TEST(AdjustmentCostsTest, DerivativesOfARayAreThoseOfDifferences) {
  const Numbers lens = {0.01, -0.004, 0.006};
  expectDerivatives(RayCost(somePoint()), {pointInWorld({0.5, -0.7, 2.2}), numbersOf(kCameraFromWorld), lens},
                    1e-6);
}

TEST(AdjustmentCostsTest, DerivativesOfADepthAreThoseOfDifferences) {
  const Numbers bias = {0.02, -0.03}, mount = {0.003, -0.002, 0.004, 0.005, -0.006};
  expectDerivatives(DepthCost(somePoint(), kMidM),
                    {pointInWorld({0.5, -0.7, 2.2}), numbersOf(kCameraFromWorld), bias, mount}, 1e-6);
}

TEST(AdjustmentCostsTest, AMeasurementIsTheTrueDepthLessTheBias) {
  const double bias[] = {0.02, -0.03};
  const double measured_m = measurementOf(3.2, bias, kMidM).depth_m;
  EXPECT_NEAR(measured_m + bias[0] + bias[1] * (measured_m - kMidM), 3.2, 1e-12);
}

}  // namespace
}  // namespace sphc::host
