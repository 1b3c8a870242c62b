// The robust loop: minimal samples, truncated scoring, local optimisation, final refinement (LO-RANSAC: Chum,
// Matas, Kittler 2003; the paper's algorithm 2 with the whitened residual in place of its cost).
#pragma once
#include "runtime/base/arena.h"
#include "runtime/stages/pose/refine.h"
#include "runtime/stages/pose/score.h"

namespace sphc {

struct EstimatorConfig {
  uint32_t capacity = 0;           // correspondences at most
  uint32_t max_iterations = 0;     // minimal samples at most
  double inlier_threshold2 = 12;   // squared whitened residual; chi-squared with 2 degrees beyond it: 0.25 %
  double miss_probability = 1e-4;  // of stopping before an all-inlier sample was drawn
};

class PoseEstimator {
 public:
  static void layout(const EstimatorConfig &config, Arena &scratch, PoseEstimator *estimator);

  // Searches from scratch.  The answer's inliers is 0 when there is none.
  Estimate search(Span<const Correspondence> correspondences, uint64_t seed);
  // Refines from a pose that is nearly right.
  Estimate refine(Span<const Correspondence> correspondences, const Rigid &camera_from_map) const;
  // Does the correspondence agree with the pose?
  bool isInlier(const Correspondence &correspondence, const Rigid &camera_from_map) const;
  double inlierThreshold2() const { return config_.inlier_threshold2; }

 private:
  struct Best {
    Rigid camera_from_map;
    float score;
  };
  void tryPose(const Rigid &camera_from_map, Span<const Correspondence> correspondences, Best *best) const;
  uint32_t countInliers(Span<const Correspondence> correspondences, const Rigid &camera_from_map) const;
  uint32_t iterationsFor(uint32_t inliers, uint32_t count) const;

  EstimatorConfig config_;
  PoseScorer scorer_;
};

}  // namespace sphc
