#include "host/mapping/pose_costs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "host/mapping/pose_block.h"

namespace sphc::host {
namespace {

// Near where the derivatives are those of small errors.
const Rigid kA = {rotationFromVector(Vector3(0.2, -0.4, 0.1)), Vector3(1, 2, -0.5)};
const Rigid kB = {rotationFromVector(Vector3(-0.1, 0.3, 0.2)), Vector3(0.8, 1.9, -0.2)};
const Rigid kOff = {rotationFromVector(Vector3(2e-4, -1e-4, 3e-4)), Vector3(0.02, -0.01, 0.03)};

// By central differences along the six motions of a block.
void expectDerivatives(const ceres::CostFunction &cost, std::vector<PoseBlock> blocks) {
  const PoseManifold manifold;
  std::vector<double> residuals(6), ahead(6), behind(6);
  std::vector<std::vector<double>> jacobians(blocks.size(), std::vector<double>(42));
  std::vector<const double *> at;
  std::vector<double *> out;
  for (PoseBlock &block : blocks) at.push_back(block.data());
  for (auto &jacobian : jacobians) out.push_back(jacobian.data());
  ASSERT_TRUE(cost.Evaluate(at.data(), residuals.data(), out.data()));
  const double step = 1e-6;
  for (size_t b = 0; b < blocks.size(); ++b)
    for (size_t k = 0; k < 6; ++k) {
      PoseBlock moved;
      const double *kept = at[b];
      at[b] = moved.data();
      for (const double sign : {1.0, -1.0}) {
        double delta[6] = {};
        delta[k] = sign * step;
        manifold.Plus(kept, delta, moved.data());
        cost.Evaluate(at.data(), (sign > 0 ? ahead : behind).data(), nullptr);
      }
      at[b] = kept;
      for (size_t row = 0; row < 6; ++row) {
        const double expected = (ahead[row] - behind[row]) / (2 * step);
        EXPECT_NEAR(jacobians[b][row * 7 + k], expected, 1e-3 * (1 + std::abs(expected)))
            << b << " " << row << " " << k;
      }
    }
}

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
  expectDerivatives(LinkCost(link), {blockFrom(kA), blockFrom(kOff * kB)});
  expectDerivatives(AnchorCost(kA.inverse(), 0.05, 0.02), {blockFrom(kOff * kA)});
}

}  // namespace
}  // namespace sphc::host
