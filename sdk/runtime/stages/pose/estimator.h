// The robust loop: batches of minimal samples, scoring with early exit, local optimisation when it can pay, final
// refinement (LO-RANSAC: Chum, Matas, Kittler 2003; the paper's algorithm 2 with the whitened residual in place of
// its cost).
#pragma once
#include "runtime/base/deadline.h"
#include "runtime/stages/pose/refine.h"
#include "runtime/stages/pose/sampler.h"

namespace sphc {

struct EstimatorConfig {
  uint32_t capacity = 0;                 // correspondences at most
  uint32_t max_iterations = 0;           // minimal samples at most
  bool has_centres = false;              // do some come from other cameras than the colour camera?
  double inlier_threshold2 = 12;         // squared whitened residual; chi-squared with 2 degrees beyond it: 0.25 %
  double miss_probability = 1e-3;        // of stopping before a sample that leads to the pose was drawn
  const PoseKernels *kernels = nullptr;  // null: the best of this machine
};

struct PoseQuery {
  Span<const Correspondence> correspondences;
  const PosePrior *prior = nullptr;  // may be null
  DepthCalibration depth;            // what is known of the sensor
  uint64_t seed = 0;
  uint32_t most_samples = UINT32_MAX;  // of a search; never more than the estimator's
  Deadline deadline;
};

class PoseEstimator {
 public:
  static void layout(const EstimatorConfig &config, Arena &scratch, PoseEstimator *estimator);

  // Searches, from the prior when there is one, else from scratch.  Estimate::ending says how it went.
  Estimate search(const PoseQuery &query);
  // Refines from a pose that is nearly right.
  Estimate refine(const PoseQuery &query, const Rigid &camera_from_map);
  // The same from the other pose that a planar scene seen obliquely has; kNoConsensus when there is none.
  Estimate refineMirrored(const PoseQuery &query, const Rigid &camera_from_map);
  // Says of a pose what refine would, and leaves it where it is.
  Estimate evaluate(const PoseQuery &query, const Rigid &camera_from_map);
  // Does the correspondence agree with the estimate?
  bool isInlier(const Correspondence &correspondence, const Estimate &estimate) const;
  void setMaxIterations(uint32_t max_iterations) { config_.max_iterations = max_iterations; }
  double inlierThreshold2() const { return config_.inlier_threshold2; }

 private:
  // Where the search stands; gains are at the wide threshold of minimal samples.
  struct Search {
    Rigid camera_from_map;
    float gain = 0;          // after local optimisation
    float minimal_gain = 0;  // before it
    float tight_gain = 0;    // after it, at the inlier threshold
    uint32_t samples = 0, hypotheses = 0;
    uint32_t begin = 0, needed = 0;           // of this round: samples before it, and those that are enough
    double chance_gain = 0, chance_seen = 0;  // of the poses that were given up: what chance alone brings
  };
  void load(const PoseQuery &query);
  bool isSupported(float gain) const;
  bool verifyPrior(const PoseQuery &query, Search *search);
  Rigid approach(const PoseQuery &query, const Rigid &start);
  void tryMirrored(const PoseQuery &query, Search *search);
  void sampleAndScore(const PoseQuery &query, const PosePrior *gate, uint32_t most, Search *search,
                      Estimate *estimate);
  uint32_t scoreBatch(const PoseQuery &query, const PosePrior *gate, uint32_t most, Watch *watch, Search *search);
  void optimise(const PoseQuery &query, const Rigid &minimal, Search *search);
  static bool isNear(const PosePrior &prior, const Rigid &pose);
  void keepNear(const RefineTask &task, const Rigid &pose, float limit2);
  void keepNearPlanes(const RefineTask &task, const Rigid &pose, float limit2);
  bool isBeyondChance(const Search &search) const;
  float gainOf(const Rigid &pose, double threshold2) const;
  uint32_t samplesFor(const PoseQuery &query, const Search &search) const;
  RefineTask task(const PoseQuery &query, double scale2) const;
  bool tellsOfDepth(const PoseRows &rows, uint32_t row, const Rigid &pose) const;
  double unitVariance(const Estimate &estimate) const;
  double noiseRatio(const NormalTask &kernel, const Rigid &pose);
  void finish(const PoseQuery &query, const Rigid &start, Estimate *estimate);
  void polish(const PoseQuery &query, const Rigid &pose, int iterations, Estimate *estimate);

  EstimatorConfig config_;
  const PoseKernels *kernels_ = nullptr;
  Sampler sampler_;
  PoseRows lifted_, planes_;     // with and without depth
  PoseRows near_, near_planes_;  // those that matter to a pose
  Span<float> squared_, plane_squared_, quality_;
  Span<uint32_t> kept_;
  MinimalBatch *batch_ = nullptr;
  PoseBatch *poses_ = nullptr;
};

}  // namespace sphc
