#include "host/mapping/pose_costs.h"

#include <gtest/gtest.h>

#include "expect_derivatives.h"

namespace sphc::host {
namespace {

// Near where the derivatives are those of small errors.
const Rigid kA = {rotationFromVector(Vector3(0.2, -0.4, 0.1)), Vector3(1, 2, -0.5)};
const Rigid kB = {rotationFromVector(Vector3(-0.1, 0.3, 0.2)), Vector3(0.8, 1.9, -0.2)};
const Rigid kOff = {rotationFromVector(Vector3(2e-4, -1e-4, 3e-4)), Vector3(0.02, -0.01, 0.03)};

TEST(PoseCostsTest, AnAnchorIsZeroAtItsPoseAndCountsSigmas) {
  const AnchorCost cost(kA.inverse(), 0.05, 0.02);
  const PoseBlock there = blockFrom(kA), off = blockFrom(Rigid{Matrix3::Identity(), Vector3(0.1, 0, 0)} * kA);
  const double *block = there.data();
  double residuals[6];
  cost.Evaluate(&block, residuals, nullptr);
  for (double r : residuals) EXPECT_NEAR(r, 0, 1e-9);
  block = off.data();
  cost.Evaluate(&block, residuals, nullptr);
  EXPECT_NEAR(residuals[3], 2, 1e-9);
}

TEST(PoseCostsTest, DerivativesAreThoseOfDifferences) {
  FrameLink link;
  link.b_from_a = kB * kA.inverse();
  link.covariance = 1e-4 * Matrix6::Identity();
  link.covariance(0, 4) = link.covariance(4, 0) = 5e-5;
  expectDerivatives(LinkCost(link), {numbersOf(kA), numbersOf(kOff * kB)}, 1e-3);
  expectDerivatives(AnchorCost(kA.inverse(), 0.05, 0.02), {numbersOf(kOff * kA)}, 1e-3);
}

}  // namespace
}  // namespace sphc::host
