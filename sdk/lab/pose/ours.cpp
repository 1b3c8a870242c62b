#include "lab/pose/ours.h"

#include <hwy/targets.h>

#include <cmath>
#include <memory>

#include "host/frames/heap_arena.h"
#include "lab/baselines/paper_estimator.h"
#include "runtime/stages/pose/depth_calibrator.h"
#include "runtime/stages/pose/estimator.h"

namespace sphc::host {
namespace {

constexpr uint32_t kMaxIterations = 100000;
constexpr double kMiddleM = 1.8;                             // geometric mean of the sensor's range
constexpr double kOffsetSigmaM = 0.003, kSlopeSigma = 0.02;  // of its bias
constexpr double kUpSigmaRad = 0.5 * kPi / 180;

PoseAnswer answerOf(const Estimate &estimate, double seconds) {
  return {estimate.camera_from_map, estimate.iterations,  estimate.hypotheses,
          estimate.inliers,         estimate.inliers > 0, seconds};
}

struct OursOptions {
  const PoseKernels *kernels = nullptr;
  bool calibrate = true;  // learn the sensor's bias from query to query, as the localizer does from frame to frame
  bool gravity = false;
};

// An estimator in memory that grows with the largest case, and what it has learnt of the sensor.
class Ours {
 public:
  explicit Ours(const OursOptions &options) : options_(options) { config_.kernels = options.kernels; }

  PoseAnswer run(const PoseCase &c, uint64_t seed) {
    if (c.index != index_ || c.name != name_) begin(c);
    PosePrior prior;
    sphc::PoseQuery query;
    query.correspondences = {rows_.data(), rows_.size()};
    query.depth = calibrator_.current();
    query.seed = seed;
    if (options_.gravity) {
      prior = vertical(c, seed);
      query.prior = &prior;
    }
    const double start = clockSeconds();
    last_ = estimator_.search(query);
    return answerOf(last_, clockSeconds() - start);
  }

 private:
  // A new query: the one before it is over, and can be learnt from.
  void begin(const PoseCase &c) {
    if (c.index == 0 || name_.empty())
      calibrator_.init(sensorPrior(c.source));
    else if (options_.calibrate && last_.ending == PoseEnding::kFound)
      calibrator_.learn(last_);
    index_ = c.index;
    name_ = c.name;
    rows_ = c.correspondences;
    rows_.insert(rows_.end(), c.without_depth.begin(), c.without_depth.end());
    reserve(static_cast<uint32_t>(rows_.size()));
  }

  // As an inertial sensor would tell it; any axis of the map serves as the vertical.
  static PosePrior vertical(const PoseCase &c, uint64_t seed) {
    Random random(seed);
    const Vector3 error(random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5);
    PosePrior prior;
    prior.has_up = true;
    prior.up_map = Vector3::UnitY();
    prior.up_sigma_rad = kUpSigmaRad;
    prior.up_camera =
        rotationFromVector(std::sqrt(12.0) * kUpSigmaRad * error) * c.truth_camera_from_map.rotation * prior.up_map;
    return prior;
  }

  void reserve(uint32_t count) {
    if (count <= config_.capacity && !memory_.empty()) return;
    config_.capacity = count;
    config_.max_iterations = kMaxIterations;
    Arena measure;
    PoseEstimator::layout(config_, measure, nullptr);
    Arena arena = heapFor(measure, &memory_);
    PoseEstimator::layout(config_, arena, &estimator_);
  }

  OursOptions options_;
  EstimatorConfig config_;
  std::vector<uint8_t> memory_;
  std::vector<Correspondence> rows_;
  PoseEstimator estimator_;
  DepthCalibrator calibrator_;
  Estimate last_;
  std::string name_;
  uint32_t index_ = 0;
};

PoseVariant ours(const std::string &name, const OursOptions &options) {
  auto estimator = std::make_shared<Ours>(options);
  return {name, false, [estimator](const PoseCase &c, uint64_t seed) { return estimator->run(c, seed); }, ""};
}

// What a machine with 128-bit registers would run; null where this one has no wider ones to leave alone.
const PoseKernels *kernelsOf128Bits() {
#if defined(__x86_64__)
  hwy::DisableTargets(HWY_AVX2 | HWY_AVX3 | HWY_AVX3_DL);
  const PoseKernels *narrow = &simdPoseKernels();
  hwy::DisableTargets(0);
  return narrow == &simdPoseKernels() ? nullptr : narrow;
#else
  return nullptr;
#endif
}

// The paper's options: more certainty where there are no fakes.
PoseVariant paper() {
  return {"paper", false,
          [](const PoseCase &c, uint64_t seed) {
            PaperCostConfig config;
            config.focal_px = c.focalPx();
            if (c.eta_percent == 100) config.success_probability = 0.9999;
            const Span<const Correspondence> rows = {c.correspondences.data(), c.correspondences.size()};
            const double begin = clockSeconds();
            const Estimate estimate = estimateWithPaperCost(config, rows, seed);
            return answerOf(estimate, clockSeconds() - begin);
          },
          ""};
}

}  // namespace

DepthCalibration sensorPrior(DepthSource source) {
  DepthCalibration prior;
  prior.mid_m = kMiddleM;
  if (source == DepthSource::kTof) {
    prior.covariance(0, 0) = kOffsetSigmaM * kOffsetSigmaM;
    prior.covariance(1, 1) = kSlopeSigma * kSlopeSigma;
  }
  return prior;
}

std::vector<PoseVariant> ourVariants() {
  std::vector<PoseVariant> variants = {ours("ours", {nullptr, true, false}),
                                       ours("ours, each frame alone", {nullptr, false, false}),
                                       ours("ours, with gravity", {nullptr, true, true})};
  if (const PoseKernels *narrow = kernelsOf128Bits())
    variants.push_back(ours("ours, 128-bit", {narrow, true, false}));
  variants.push_back(ours("ours, scalar", {&scalarPoseKernels(), true, false}));
  variants.push_back(paper());
  return variants;
}

}  // namespace sphc::host
