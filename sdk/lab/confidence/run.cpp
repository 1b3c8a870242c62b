#include "lab/confidence/run.h"

#include "host/report/statistics.h"
#include "lab/pose/bench.h"
#include "lab/pose/ours.h"
#include "runtime/stages/pose/depth_calibrator.h"
#include "runtime/stages/pose/estimator.h"

namespace sphc::host {
namespace {

constexpr uint32_t kCapacity = 8192, kMaxIterations = 20000;  // the latter as the localizer's default

// An estimator in memory of its own.
class HeldEstimator {
 public:
  HeldEstimator() {
    EstimatorConfig config;
    config.capacity = kCapacity;
    config.max_iterations = kMaxIterations;
    Arena measure;
    PoseEstimator::layout(config, measure, nullptr);
    memory_.resize(measure.used() + kArenaAlignment);
    uint8_t *start = memory_.data();
    start += (kArenaAlignment - reinterpret_cast<uintptr_t>(start) % kArenaAlignment) % kArenaAlignment;
    Arena arena(start);
    PoseEstimator::layout(config, arena, &estimator_);
  }
  Estimate search(const ConfidenceQuery &asked, uint64_t seed) {
    const PoseCase &c = asked.pose_case;
    rows_ = c.correspondences;
    rows_.insert(rows_.end(), c.without_depth.begin(), c.without_depth.end());
    if (rows_.size() > kCapacity) rows_.resize(kCapacity);
    sphc::PoseQuery query;
    query.correspondences = {rows_.data(), rows_.size()};
    query.depth = asked.depth;
    query.seed = seed;
    return estimator_.search(query);
  }

 private:
  std::vector<uint8_t> memory_;
  std::vector<Correspondence> rows_;
  PoseEstimator estimator_;
};

void runOne(const ConfidenceQuery &query, const Hardship &hardship, uint64_t seed, HeldEstimator *estimator,
            std::vector<ConfidenceRun> *runs) {
  const Estimate estimate = estimator->search(query, seed);
  if (estimate.ending != PoseEnding::kFound) return;
  PoseAnswer answer;
  answer.camera_from_map = estimate.camera_from_map;
  answer.found = true;
  PoseSample sample;
  judgePose(answer, query.pose_case.truth_camera_from_map, &sample);
  const bool correct =
      sample.translation_error_m <= kGoodTranslationM && sample.rotation_error_deg <= kGoodRotationDeg;
  runs->push_back({describe(hardship), confidenceInputs(estimate, estimate), sample.rotation_error_deg,
                   sample.translation_error_m, correct});
}

}  // namespace

std::vector<ConfidenceQuery> calibratedQueries(const std::vector<PoseCase> &cases) {
  HeldEstimator estimator;
  DepthCalibrator calibrator;
  std::vector<ConfidenceQuery> queries;
  for (const PoseCase &c : cases) {
    if (queries.empty()) calibrator.init(sensorPrior(c.source));
    queries.push_back({c, calibrator.current()});
    const Estimate estimate = estimator.search(queries.back(), queries.size());
    if (estimate.ending == PoseEnding::kFound) calibrator.learn(estimate);
  }
  return queries;
}

void runConfidence(const std::vector<ConfidenceQuery> &queries, const CaseNoise &noise, uint32_t times,
                   uint64_t seed, const RunDone &done, std::vector<ConfidenceRun> *runs) {
  HeldEstimator estimator;
  Random random(seed);
  for (size_t i = 0; i < queries.size(); ++i) {
    for (uint32_t time = 0; time < times; ++time) {
      const Hardship hardship = drawHardship(&random);
      const ConfidenceQuery query = hardQuery(queries[i], hardship, noise, &random);
      runOne(query, hardship, random.next(), &estimator, runs);
    }
    if (done) done(static_cast<uint32_t>(i + 1), static_cast<uint32_t>(queries.size()));
  }
}

ConfidenceScene runMadeWorlds(MadeWorld world, uint32_t count, uint64_t seed, const RunDone &done) {
  const CaseNoise noise = noiseFor(DepthSource::kTof);
  std::vector<ConfidenceQuery> queries;
  for (uint32_t i = 0; i < count; ++i) queries.push_back(madeQuery(world, seed + i, noise));
  ConfidenceScene scene = {worldName(world), false, {}};
  runConfidence(queries, noise, 1, seed + count, done, &scene.runs);
  return scene;
}

}  // namespace sphc::host
