// The only composer of the stages: features > align > match > pose, then once more with what the first pose tells.
// Frame after frame: a predicted pose says where in the map to look, and the whole maps are searched where it
// fails.
#pragma once
#include "runtime/base/fixed_vector.h"
#include "runtime/localizer/front_end.h"
#include "runtime/localizer/history.h"
#include "runtime/localizer/judgement.h"
#include "runtime/localizer/tracker.h"
#include "runtime/map/map_view.h"
#include "runtime/stages/match/matcher.h"
#include "runtime/stages/pose/depth_calibrator.h"
#include "runtime/stages/pose/estimator.h"
#include "runtime/stages/pose/lever.h"
#include "runtime/stages/pose/paper_estimator.h"

namespace sphc {

class Localizer {
 public:
  static constexpr uint32_t kMostProbes = Matcher::kMaxProbes;

  // One walk for both memories; `localizer` is null while measuring.
  static void layout(const sphc_config &config, Arena &state, Arena &scratch, Localizer *localizer);

  // Once, after layout with memory; then each map, at most SPHC_MAPS_MAX.
  void init(const sphc_config &config);
  void addMap(const MapView &map) { maps_.push(map); }
  // `frame` has been validated against the config.
  void process(const sphc_frame &frame, sphc_result *result);
  // Forgets where the camera was; what was learnt of the depth sensor stays.
  void reset();

  const sphc_config &config() const { return config_; }
  uint32_t mapCount() const { return static_cast<uint32_t>(maps_.size()); }
  Span<const sphc_observation> observations() const { return front_.observations(); }

 private:
  using MapOrder = FixedVector<uint32_t, SPHC_MAPS_MAX>;

  // What one look at one map brought.
  struct Look {
    uint32_t map = 0;
    bool guided = false;
    uint32_t frames = 1;  // whose matches were put together
    sphc_outcome outcome = SPHC_OUTCOME_FEW_MATCHES;
    Estimate searched, estimate;
    Evidence evidence = {};
    Levers levers;
  };
  // What stands for the frame: its matches are in kept_matches_.
  struct Kept {
    bool any = false;
    Look look;
    uint32_t matches = 0;
  };

  using Caps = Span<const double>;

  void advance(const sphc_frame &frame, const Known &known);
  Rigid colorFromDepth(const sphc_frame &frame) const;
  void locate(const Known &known, const Deadline &deadline);
  void consider(const Look &look);
  bool isDone(const Deadline &deadline) const;
  bool expect(const Known &known, Prediction *expected) const;
  Look lookNear(const Known &known, const Deadline &deadline, const Prediction &expected);
  void lookEverywhere(const Known &known, const Deadline &deadline);
  void lookInto(uint32_t map, PoseQuery query, bool remembers);
  Look lookTogether(uint32_t map, PoseQuery query);
  void findPose(const PoseQuery &query, double solid_angle_sr, Caps caps_rad, Look *look);
  void improve(PoseQuery query, Caps caps_rad, Look *look);
  void findLevers(Look *look) const;
  void contest(const PoseQuery &query, Caps caps_rad, Look *look);
  void contestMirrored(PoseQuery query, Caps caps_rad, Look *look);
  MapOrder rankMaps();
  uint32_t mapToRemember(const MapOrder &order) const;
  bool remember(uint32_t map);

  PosePrior priorFor(const Known &known, uint32_t map) const;
  PoseQuery queryFor(const PosePrior &prior, const Deadline &deadline) const;
  Estimate firstPose(const PoseQuery &query);
  Estimate refined(const PoseQuery &query, const Rigid &camera_from_map);
  PaperCostConfig paperConfig() const;
  void askAbout(uint32_t map, uint32_t keypoints, uint32_t probes);
  Span<const Correspondence> matchEverywhere(uint32_t map, uint32_t keypoints);
  uint32_t matchAround(const Rigid &camera_from_map, double cap_rad);
  void keepRays();
  Span<const Correspondence> correspond(uint32_t map, uint32_t match_count);
  Correspondence correspondenceOf(uint32_t map, const Match &match) const;
  Span<const Correspondence> withHistory(uint32_t map);
  Vector3 directionOf(uint32_t map, uint32_t point) const;

  void conclude(sphc_result *result);
  void fillPose(const Estimate &estimate, sphc_result *result) const;
  void recordDepth(sphc_result *result) const;
  void log(const sphc_result &result) const;
  bool isPaper() const { return config_.cost == SPHC_COST_PAPER; }
  bool tracks() const { return config_.mode == SPHC_MODE_TRACKING && !isPaper(); }
  int64_t now() const { return config_.clock ? config_.clock(config_.clock_user) : 0; }

  sphc_config config_ = {};
  FixedVector<MapView, SPHC_MAPS_MAX> maps_;
  FrontEnd front_;
  Matcher matcher_;
  PoseEstimator estimator_;
  DepthCalibrator calibrator_;
  Tracker tracker_;
  History history_;
  uint32_t history_map_ = 0;

  // In scratch.
  Span<Direction> expected_;
  Span<Match> matches_, ray_matches_;  // ray_matches_: of keypoints without depth, from the first look
  Span<Match> kept_matches_;
  Span<Correspondence> correspondences_;
  uint32_t match_count_ = 0, ray_match_count_ = 0;
  uint32_t used_count_ = 0;  // correspondences: of the matches, and of the history behind them

  // Of this frame.
  Kept kept_;
  uint32_t samples_ = 0;
  uint64_t match_ns_ = 0;
};

}  // namespace sphc
