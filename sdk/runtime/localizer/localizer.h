// The only composer of the stages: features > align > match > pose, then once more with what the first pose tells.
#pragma once
#include "runtime/base/arena.h"
#include "runtime/map/map_view.h"
#include "runtime/stages/align/sparse.h"
#include "runtime/stages/features/extractor.h"
#include "runtime/stages/match/matcher.h"
#include "runtime/stages/pose/depth_calibrator.h"
#include "runtime/stages/pose/estimator.h"
#include "runtime/stages/pose/paper_estimator.h"

namespace sphc {

class Localizer {
 public:
  // One walk for both memories; `localizer` is null while measuring.
  static void layout(const sphc_config &config, Arena &state, Arena &scratch, Localizer *localizer);

  // Once, after layout with memory.
  void init(const sphc_config &config, const MapView &map);
  // `frame` has been validated against the config.
  void process(const sphc_frame &frame, sphc_result *result);

  const sphc_config &config() const { return config_; }
  Span<const sphc_observation> observations() const { return observations_.first(observation_count_); }

 private:
  void extract(const sphc_image &color);
  void lift(const sphc_image &depth);
  void toFront(uint32_t keypoint);
  void search(const sphc_prior *prior, const Deadline &deadline, sphc_result *result);
  void improve(const PoseQuery &query, Estimate *estimate, sphc_result *result);
  uint32_t matchAgain(const Rigid &camera_from_map, double cap_rad);
  void keepRays();
  Span<const Correspondence> correspond(uint32_t match_count);
  Estimate firstPose(const PoseQuery &query);
  Estimate refined(const PoseQuery &query, const Rigid &camera_from_map);
  PaperCostConfig paperConfig() const;
  void recordMatches();
  void recordDepth(sphc_result *result) const;
  void fill(const Estimate &estimate, sphc_result *result) const;
  void log(const sphc_result &result) const;
  int64_t now() const { return config_.clock ? config_.clock(config_.clock_user) : 0; }

  sphc_config config_ = {};
  MapView map_;
  SparseAligner aligner_;
  FeatureExtractor extractor_;
  Matcher matcher_;
  PoseEstimator estimator_;
  DepthCalibrator calibrator_;

  Span<sphc_observation> observations_;  // in state: readable until the next frame
  uint32_t observation_count_ = 0;

  // In scratch.
  Span<uint8_t> gray_;
  Span<Keypoint> keypoints_;
  Span<Descriptor> descriptors_;
  Span<LiftedPoint> lifted_;    // those with depth first, then those without
  Span<uint32_t> keypoint_of_;  // which keypoint each of them is
  Span<Direction> expected_;
  Span<Match> matches_, ray_matches_;  // ray_matches_: of keypoints without depth, from the first look
  Span<Correspondence> correspondences_;
  uint32_t keypoint_count_ = 0, lifted_count_ = 0, match_count_ = 0, ray_match_count_ = 0;
};

}  // namespace sphc
