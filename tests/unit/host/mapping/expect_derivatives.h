// Are the derivatives of a residual those of differences?
#pragma once
#include <ceres/cost_function.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "host/mapping/pose_block.h"

namespace sphc::host {

using Numbers = std::vector<double>;

inline Numbers numbersOf(const Rigid &pose) {
  const PoseBlock block = blockFrom(pose);
  return {block.begin(), block.end()};
}

// A block of seven numbers is a pose, which moves by six.
inline Numbers moved(const Numbers &block, size_t k, double by) {
  Numbers to = block;
  if (block.size() != 7) {
    to[k] += by;
    return to;
  }
  double delta[6] = {};
  delta[k] = by;
  PoseManifold().Plus(block.data(), delta, to.data());
  return to;
}

inline Numbers residualsAt(const ceres::CostFunction &cost, const std::vector<Numbers> &blocks,
                           std::vector<Numbers> *jacobians) {
  Numbers residuals(static_cast<size_t>(cost.num_residuals()));
  std::vector<const double *> at;
  std::vector<double *> out;
  for (const Numbers &block : blocks) at.push_back(block.data());
  if (jacobians)
    for (Numbers &jacobian : *jacobians) out.push_back(jacobian.data());
  EXPECT_TRUE(cost.Evaluate(at.data(), residuals.data(), jacobians ? out.data() : nullptr));
  return residuals;
}

// By central differences along each number of each block; `tolerance`: relative.
inline void expectDerivatives(const ceres::CostFunction &cost, const std::vector<Numbers> &blocks,
                              double tolerance) {
  constexpr double kStep = 1e-6;
  std::vector<Numbers> jacobians;
  for (const Numbers &block : blocks)
    jacobians.emplace_back(static_cast<size_t>(cost.num_residuals()) * block.size());
  const size_t rows = residualsAt(cost, blocks, &jacobians).size();
  for (size_t b = 0; b < blocks.size(); ++b)
    for (size_t k = 0; k < (blocks[b].size() == 7 ? 6 : blocks[b].size()); ++k) {
      std::vector<Numbers> ahead = blocks, behind = blocks;
      ahead[b] = moved(blocks[b], k, kStep);
      behind[b] = moved(blocks[b], k, -kStep);
      const Numbers r_ahead = residualsAt(cost, ahead, nullptr), r_behind = residualsAt(cost, behind, nullptr);
      for (size_t row = 0; row < rows; ++row) {
        const double expected = (r_ahead[row] - r_behind[row]) / (2 * kStep);
        EXPECT_NEAR(jacobians[b][row * blocks[b].size() + k], expected, tolerance * (1 + std::abs(expected)))
            << b << " " << row << " " << k;
      }
    }
}

}  // namespace sphc::host
