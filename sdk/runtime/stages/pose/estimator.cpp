#include "runtime/stages/pose/estimator.h"

#include <Eigen/Cholesky>

#include "runtime/base/random.h"
#include "runtime/stages/pose/p3p.h"
#include "runtime/stages/pose/residual.h"

namespace sphc {
namespace {

constexpr uint32_t kSampleSize = 3;
constexpr int kLocalIterations = 4, kFinalIterations = 12;
constexpr double kWideScale2 = 8, kFinalScale2 = 4;  // of the Geman-McClure loss

void drawSample(Random *random, uint32_t count, uint32_t sample[kSampleSize]) {
  sample[0] = random->below(count);
  do sample[1] = random->below(count);
  while (sample[1] == sample[0]);
  do sample[2] = random->below(count);
  while (sample[2] == sample[0] || sample[2] == sample[1]);
}

}  // namespace

void PoseEstimator::layout(const EstimatorConfig &config, Arena &scratch, PoseEstimator *estimator) {
  PoseScorer::layout(config.capacity, scratch, estimator ? &estimator->scorer_ : nullptr);
  if (estimator) estimator->config_ = config;
}

bool PoseEstimator::isInlier(const Correspondence &correspondence, const Rigid &camera_from_map) const {
  const Residual r = residualOf(correspondence, camera_from_map);
  return r.in_front && r.squared < config_.inlier_threshold2;
}

uint32_t PoseEstimator::countInliers(Span<const Correspondence> correspondences,
                                     const Rigid &camera_from_map) const {
  uint32_t inliers = 0;
  for (const Correspondence &c : correspondences) inliers += isInlier(c, camera_from_map);
  return inliers;
}

// Samples needed to draw one without an outlier (Fischler and Bolles 1981).
uint32_t PoseEstimator::iterationsFor(uint32_t inliers, uint32_t count) const {
  const double share = static_cast<double>(inliers) / count, good = share * share * share;
  if (good > 0.999) return 1;
  if (good < 1e-9) return config_.max_iterations;
  const double needed = logOf(config_.miss_probability) / logOf(1 - good);
  return needed < config_.max_iterations ? static_cast<uint32_t>(needed) + 1 : config_.max_iterations;
}

void PoseEstimator::tryPose(const Rigid &pose, Span<const Correspondence> correspondences, Best *best) const {
  const float truncation = static_cast<float>(config_.inlier_threshold2);
  const float score = scorer_.score(pose, truncation, best->score);
  if (!(score < best->score)) return;
  *best = {pose, score};
  const Rigid local = refinePose(correspondences, pose, kWideScale2, kLocalIterations).camera_from_map;
  const float local_score = scorer_.score(local, truncation, best->score);
  if (local_score < best->score) *best = {local, local_score};
}

Estimate PoseEstimator::search(Span<const Correspondence> correspondences, uint64_t seed) {
  Estimate none;
  const uint32_t count = static_cast<uint32_t>(correspondences.size());
  if (count < kSampleSize + 1) return none;
  scorer_.load(correspondences);
  Random random(seed);
  Best best = {Rigid(), static_cast<float>(config_.inlier_threshold2) * static_cast<float>(count)};
  uint32_t needed = config_.max_iterations, iterations = 0;
  bool found = false;
  while (iterations < needed) {
    ++iterations;
    uint32_t sample[kSampleSize];
    drawSample(&random, count, sample);
    Vector3 bearing[kSampleSize], point[kSampleSize];
    for (uint32_t k = 0; k < kSampleSize; ++k) {
      bearing[k] = correspondences[sample[k]].direction;
      point[k] = correspondences[sample[k]].lifted.point_m;
    }
    const float before = best.score;
    for (const Rigid &map_from_camera : solveP3p(bearing, point))
      tryPose(map_from_camera.inverse(), correspondences, &best);
    if (!(best.score < before)) continue;
    found = true;
    needed = iterationsFor(countInliers(correspondences, best.camera_from_map), count);
  }
  none.iterations = iterations;
  if (!found) return none;
  Estimate estimate = refine(correspondences, best.camera_from_map);
  estimate.iterations = iterations;
  return estimate;
}

Estimate PoseEstimator::refine(Span<const Correspondence> correspondences, const Rigid &camera_from_map) const {
  const Refinement refined = refinePose(correspondences, camera_from_map, kFinalScale2, kFinalIterations);
  Estimate estimate;
  estimate.camera_from_map = refined.camera_from_map;
  estimate.inliers = countInliers(correspondences, refined.camera_from_map);
  Matrix6 information = refined.information;
  information.diagonal().array() += 1e-6;  // a direction that nothing pins down gets a large, finite variance
  estimate.covariance = information.ldlt().solve(Matrix6::Identity());
  return estimate;
}

}  // namespace sphc
