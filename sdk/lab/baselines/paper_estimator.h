// The paper's own estimator, as a baseline: LO-RANSAC on squared epipolar error plus lambda times squared relative
// depth error (Moon et al., BMVC 2024, equations 1 to 3; supplement, section 1.2 and algorithm 2).
#pragma once
#include "runtime/base/span.h"
#include "runtime/types/correspondence.h"
#include "runtime/types/estimate.h"

namespace sphc::host {

struct PaperCostConfig {
  double focal_px = 0;
  double epipolar_gate_px = 1.5;
  double depth_gate = 0.1;  // of |beta - 1|
  double lambda = 1e-4;     // weight of the depth term
  // Stops when an all-inlier sample was missed with a smaller probability, after `trial_multiplier` times as many
  // samples as that takes.
  double success_probability = 0.95;
  double trial_multiplier = 3;
  uint32_t min_iterations = 10, max_iterations = 100000;
};

// One correspondence under a pose.
struct PaperResidual {
  double epipolar2;  // squared distance of the keypoint from the epipolar line, at focal length 1 (equation 1)
  double beta;       // predicted depth over measured depth, by intersection in the XZ plane (supplement, 1.2)
  bool in_front;     // cheirality on both sides: beta > 0 and the ray's parameter alpha > 0
};
PaperResidual paperResidualOf(const Correspondence &correspondence, const Rigid &camera_from_map);

// Sum of min(epipolar2 + lambda (beta - 1)^2, gate), and how many pass both gates.
struct PaperScore {
  double msac;
  uint32_t inliers;
};
PaperScore paperScoreOf(const PaperCostConfig &config, Span<const Correspondence> correspondences,
                        const Rigid &camera_from_map);

// Levenberg-Marquardt on that truncated sum.
Rigid refineWithPaperCost(const PaperCostConfig &config, Span<const Correspondence> correspondences,
                          const Rigid &start, int iterations);

// The answer's inliers is 0 when there is none; it has no covariance.
Estimate estimateWithPaperCost(const PaperCostConfig &config, Span<const Correspondence> correspondences,
                               uint64_t seed);

}  // namespace sphc::host
