#include "lab/baselines/robust_pose.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "lab/baselines/pose_step.h"

namespace sphc::host {
namespace {

struct Score {
  double cost = std::numeric_limits<double>::infinity();
  uint32_t inliers = 0;
};

Score scoreOf(const PoseProblem &problem, const Rigid &pose, double gate2, double give_up_at) {
  Score score = {0, 0};
  for (uint32_t i = 0; i < problem.count() && score.cost < give_up_at; ++i) {
    const double squared = problem.squaredError(i, pose);
    score.inliers += squared < gate2;
    score.cost += squared < gate2 ? squared : gate2;  // so NaN is no inlier
  }
  return score;
}

PoseEquations equationsAt(const PoseProblem &problem, const Rigid &pose, double gate2) {
  PoseEquations equations;
  for (uint32_t i = 0; i < problem.count(); ++i)
    if (problem.squaredError(i, pose) < gate2) problem.addEquations(i, pose, &equations);
  return equations;
}

constexpr double kFirstDamping = 1e-4, kDampingStep = 10, kMostDamping = 1e6, kEnoughProgress = 1e-9;
constexpr double kOutOfReach = std::numeric_limits<double>::infinity();

// Levenberg-Marquardt on the truncated sum.
Rigid refined(const PoseProblem &problem, const RobustPoseOptions &options, Rigid pose) {
  const double gate2 = options.gate_px * options.gate_px;
  double cost = scoreOf(problem, pose, gate2, kOutOfReach).cost, damping = kFirstDamping;
  PoseEquations equations = equationsAt(problem, pose, gate2);
  for (uint32_t k = 0; k < options.refine_iterations && damping < kMostDamping; ++k) {
    auto damped = equations.normal;
    damped.diagonal() *= 1 + damping;
    const Rigid next = moved(pose, damped.ldlt().solve(equations.right));
    const double next_cost = scoreOf(problem, next, gate2, kOutOfReach).cost;
    if (!(next_cost < cost)) {
      damping *= kDampingStep;
      continue;
    }
    const bool arrived = cost - next_cost < kEnoughProgress * cost;
    pose = next, cost = next_cost, damping /= kDampingStep;
    if (arrived) break;
    equations = equationsAt(problem, pose, gate2);
  }
  return pose;
}

uint32_t samplesFor(const PoseProblem &problem, const RobustPoseOptions &options, uint32_t inliers) {
  const double share = static_cast<double>(inliers) / problem.count();
  const double hit = std::pow(share, problem.sampleSize());
  const double needed = hit >= 1 ? 1 : std::log(1 - options.success_probability) / std::log1p(-hit);
  return static_cast<uint32_t>(
      std::clamp(needed, static_cast<double>(options.min_iterations), static_cast<double>(options.max_iterations)));
}

}  // namespace

bool PoseProblem::drawSample(Random *random, std::vector<uint32_t> *sample) const {
  sample->clear();
  if (count() < sampleSize()) return false;
  while (sample->size() < sampleSize()) {
    const uint32_t match = random->below(count());
    if (std::find(sample->begin(), sample->end(), match) == sample->end()) sample->push_back(match);
  }
  return true;
}

RobustPose findPose(const PoseProblem &problem, const RobustPoseOptions &options, uint64_t seed) {
  const double gate2 = options.gate_px * options.gate_px;
  Random random(seed);
  RobustPose best;
  Score minimal_best, refined_best;
  std::vector<uint32_t> sample;
  uint32_t needed = options.max_iterations;
  while (best.iterations < needed && problem.drawSample(&random, &sample)) {
    ++best.iterations;
    const std::vector<Rigid> poses = problem.solve(sample);
    best.hypotheses += static_cast<uint32_t>(poses.size());
    const Rigid *winner = nullptr;
    for (const Rigid &pose : poses) {
      const Score score = scoreOf(problem, pose, gate2, minimal_best.cost);
      if (score.cost < minimal_best.cost) minimal_best = score, winner = &pose;
    }
    if (!winner) continue;
    const Rigid local = refined(problem, options, *winner);
    const Score score = scoreOf(problem, local, gate2, refined_best.cost);
    if (!(score.cost < refined_best.cost)) continue;
    refined_best = score;
    best.camera_from_map = local;
    best.inliers = score.inliers >= problem.sampleSize() ? score.inliers : 0;
    needed = std::max(samplesFor(problem, options, score.inliers), best.iterations);
  }
  return best;
}

}  // namespace sphc::host
