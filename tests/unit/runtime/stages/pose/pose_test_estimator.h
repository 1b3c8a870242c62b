// An estimator in memory of its own.
#pragma once
#include <vector>

#include "runtime/localizer/judgement.h"
#include "runtime/stages/pose/estimator.h"
#include "tests/support/pose_world.h"

namespace sphc::test {

class TestEstimator {
 public:
  explicit TestEstimator(uint32_t capacity = 4096, uint32_t max_iterations = 20000) {
    EstimatorConfig config;
    config.capacity = capacity;
    config.max_iterations = max_iterations;
    Arena measure;
    PoseEstimator::layout(config, measure, nullptr);
    memory_.resize(measure.used() + kArenaAlignment);
    uint8_t *start = memory_.data();
    while (reinterpret_cast<uintptr_t>(start) % kArenaAlignment) ++start;
    Arena arena(start);
    PoseEstimator::layout(config, arena, &estimator_);
  }
  Estimate search(const PoseWorld &world, uint64_t seed = 1) {
    PoseQuery query;
    query.correspondences = {world.correspondences.data(), world.correspondences.size()};
    query.seed = seed;
    return estimator_.search(query);
  }
  PoseEstimator &get() { return estimator_; }
  // As the localizer judges a first pose that no second look supports.
  sphc_outcome judge(const PoseWorld &world, const Estimate &estimate) const {
    const double log_chance =
        logChanceOfAgreement({world.correspondences.data(), world.correspondences.size()}, estimate.camera_from_map,
                             estimate.inliers, 3, estimator_.inlierThreshold2(), 4 * kPi) +
        logOf(static_cast<double>(estimate.iterations));
    return judgePose({estimate.inliers, log_chance, 0}, estimate, 10);
  }

 private:
  std::vector<uint8_t> memory_;
  PoseEstimator estimator_;
};

}  // namespace sphc::test
