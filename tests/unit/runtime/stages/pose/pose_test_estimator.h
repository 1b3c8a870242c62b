// An estimator in memory of its own.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "runtime/localizer/judgement.h"
#include "runtime/stages/pose/estimator.h"
#include "tests/support/arena_memory.h"
#include "tests/support/pose_world.h"

namespace sphc::test {

class TestEstimator {
 public:
  explicit TestEstimator(uint32_t capacity = 4096, uint32_t max_iterations = 20000,
                         const PoseKernels *kernels = nullptr)
      : memory_([&](Arena &arena, bool real) {
          EstimatorConfig config;
          config.capacity = capacity;
          config.max_iterations = max_iterations;
          config.kernels = kernels;
          PoseEstimator::layout(config, arena, real ? &estimator_ : nullptr);
        }) {}
  Estimate search(const PoseWorld &world, uint64_t seed = 1) {
    PoseQuery query;
    query.seed = seed;
    return search(world, query);
  }
  // The query's correspondences are the world's.
  Estimate search(const PoseWorld &world, PoseQuery query) {
    query.correspondences = {world.correspondences.data(), world.correspondences.size()};
    return estimator_.search(query);
  }
  PoseEstimator &get() { return estimator_; }
  // As the localizer judges a first pose that no guided re-matching supports.
  Outcome judge(const PoseWorld &world, const Estimate &estimate) const {
    const double log_chance =
        logChanceOfAgreement({world.correspondences.data(), world.correspondences.size()}, estimate.camera_from_map,
                             estimate.inliers, {1, estimator_.inlierThreshold2(), 4 * kPi}) +
        logOf(static_cast<double>(estimate.iterations));
    return judgePose({estimate.inliers, log_chance, 0}, estimate, 10);
  }
  // As it judges a pose that was expected where the world's camera is.
  Outcome judgeExpected(const PoseWorld &world, double cone_rad) {
    PosePrior prior;
    prior.has_pose = true;
    prior.camera_from_map = world.camera_from_map;
    prior.rotation_sigma_rad = 0.005;
    prior.translation_sigma_m = 0.015;
    PoseQuery query;
    query.prior = &prior;
    const Estimate estimate = search(world, query);
    const double log_chance = logChanceOfAgreement(
        {world.correspondences.data(), world.correspondences.size()}, estimate.camera_from_map, estimate.inliers,
        {1, estimator_.inlierThreshold2(), 2 * kPi * (1 - std::cos(cone_rad))});
    const double tried = logOf(static_cast<double>(estimate.iterations) + 1);
    return judgePose({estimate.inliers, log_chance + tried, log_chance, MatchSource::kExpected}, estimate, 10);
  }

 private:
  PoseEstimator estimator_;
  ArenaMemory memory_;
};

// Within a degree and 2 cm of the truth.
inline bool isFound(const Estimate &estimate, const PoseWorld &world) {
  return rotationErrorRad(estimate.camera_from_map, world.camera_from_map) < 1.0 * kPi / 180 &&
         translationErrorM(estimate.camera_from_map, world.camera_from_map) < 0.02;
}

inline double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

}  // namespace sphc::test
