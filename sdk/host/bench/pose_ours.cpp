#include "host/bench/pose_ours.h"

#include <memory>

#include "runtime/stages/pose/estimator.h"
#include "runtime/stages/pose/paper_estimator.h"

namespace sphc::host {
namespace {

constexpr uint32_t kMaxIterations = 20000;  // as the library's default

Span<const Correspondence> rowsOf(const PoseCase &c) {
  return {c.correspondences.data(), c.correspondences.size()};
}

PoseAnswer answerOf(const Estimate &estimate, double seconds) {
  return {estimate.camera_from_map, estimate.iterations, estimate.inliers, estimate.inliers > 0, seconds};
}

// An estimator in memory that grows with the largest case.
class Ours {
 public:
  PoseAnswer run(const PoseCase &c, uint64_t seed) {
    reserve(static_cast<uint32_t>(c.correspondences.size()));
    const double begin = clockSeconds();
    const Estimate estimate = estimator_.search(rowsOf(c), seed);
    return answerOf(estimate, clockSeconds() - begin);
  }

 private:
  void reserve(uint32_t count) {
    if (count <= config_.capacity) return;
    config_.capacity = count;
    config_.max_iterations = kMaxIterations;
    Arena measure;
    PoseEstimator::layout(config_, measure, nullptr);
    memory_.assign(measure.used() + kArenaAlignment, 0);
    uint8_t *start = memory_.data();
    start += (kArenaAlignment - reinterpret_cast<uintptr_t>(start) % kArenaAlignment) % kArenaAlignment;
    Arena arena(start);
    PoseEstimator::layout(config_, arena, &estimator_);
  }

  EstimatorConfig config_;
  std::vector<uint8_t> memory_;
  PoseEstimator estimator_;
};

PoseVariant ours() {
  auto estimator = std::make_shared<Ours>();
  return {"ours", false, [estimator](const PoseCase &c, uint64_t seed) { return estimator->run(c, seed); }, ""};
}

// The paper's options: more certainty where there are no fakes.
PoseVariant paper() {
  return {"paper", false,
          [](const PoseCase &c, uint64_t seed) {
            PaperCostConfig config;
            config.focal_px = c.focalPx();
            if (c.eta_percent == 100) config.success_probability = 0.9999;
            const double begin = clockSeconds();
            const Estimate estimate = estimateWithPaperCost(config, rowsOf(c), seed);
            return answerOf(estimate, clockSeconds() - begin);
          },
          ""};
}

}  // namespace

std::vector<PoseVariant> ourVariants() { return {ours(), paper()}; }

}  // namespace sphc::host
