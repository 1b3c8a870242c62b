// The only composer of the stages: a frame in, a pose out.  Frame after frame: a predicted pose says where in the
// map to look, and the whole maps are searched where it fails.
#pragma once
#include "runtime/localizer/between_images.h"
#include "runtime/localizer/config.h"
#include "runtime/localizer/doubt.h"
#include "runtime/localizer/frame.h"
#include "runtime/localizer/front_end.h"
#include "runtime/localizer/fusion.h"
#include "runtime/localizer/handedness.h"
#include "runtime/localizer/hints.h"
#include "runtime/localizer/odometry_check.h"
#include "runtime/localizer/pose_finder.h"
#include "runtime/localizer/recent_ambiguity.h"
#include "runtime/localizer/result.h"
#include "runtime/localizer/tracker.h"
#include "runtime/stages/align/depth_reader.h"
#include "runtime/stages/consistency/consistency.h"
#include "runtime/stages/pose/depth_calibrator.h"

namespace sphc {

class Localizer {
 public:
  static constexpr uint32_t kMostProbes = Matcher::kMaxProbes;

  // One walk for both memories; `localizer` is null while measuring.
  static void layout(const LocalizerConfig &config, Arena &state, Arena &scratch, Localizer *localizer);

  Localizer();
  // Once, after layout with memory.
  void init(const LocalizerConfig &config);

  // Between frames.  Adds a map, or replaces the one of this id by another of the same frame; false where there is
  // no room for one more.
  bool setMap(uint32_t id, const MapView &map);
  // False where there is none of this id.
  bool removeMap(uint32_t id);
  bool placeMap(uint32_t id, const Placement &placement);
  const MapSet &maps() const { return finder_.maps(); }
  const SearchParameters &parameters() const { return finder_.parameters(); }
  void setParameters(const SearchParameters &parameters) { finder_.setParameters(parameters); }
  const DepthCalibration &depthPrior() const { return config_.depth_prior; }
  void setDepth(const DepthCalibration &known) { calibrator_.resume(known); }

  // `frame` fits the config.
  LocalizerResult process(const FrameInput &frame);
  // The same in two halves.  While one thread locates a frame, another may extract the features of the next: the
  // first half touches nothing that the second does.  `features` are of this config.
  void extract(const FrameInput &frame, FrameFeatures *features);
  LocalizerResult locate(const FrameInput &frame, const FrameFeatures &features);
  // Between frames: where the camera is at a time of the caller's; false where that is not known.
  bool predict(int64_t time_ns, MovedPose *moved) const;
  TrackingState state() const { return tracker_.state(); }
  // Forgets where the camera was; what was learnt of the depth sensor stays.
  void reset();

  // The probability that a pose of this covariance, of a result, has errors within these bounds.
  static double confidenceWithin(const Matrix6 &covariance, double translation_m, double rotation_rad);

  const LocalizerConfig &config() const { return config_; }

  // Of the last frame.
  Span<const Observation> observations() const { return front_.observations(); }
  Span<const RankedPose> hypotheses() const { return finder_.ranking().poses(); }
  const BetweenImages &betweenImages() const { return between_; }

 private:
  DepthImages read(const DepthViews &views);
  Deadline deadlineFrom(int64_t begin_ns, int64_t limit_ns) const;
  CameraRate rateAt(int64_t time_ns) const;
  void follow(const FrameInput &frame);
  LocalizerResult locateShown(const FrameInput &frame, const Deadline &deadline, int64_t begin_ns);
  const Tracker *tracker() const { return config_.tracks ? &tracker_ : nullptr; }
  Hypothesis &best() { return finder_.best(); }
  const Hypothesis &best() const { return finder_.best(); }
  void answer(const FrameInput &frame, const Deadline &deadline, Faults *faults, Work *work);
  void findPose(const Known &known, const Deadline &deadline, Faults *faults, Work *work);
  void checkVertical(const Known &known, const Deadline &deadline, Faults *faults, Work *work);
  void checkFocalLength(const Deadline &deadline, Faults *faults, Work *work);
  void compareWithTrack(const FrameInput &frame, Faults *faults);
  bool wouldMakeTrackSure(const Known &known, Faults faults) const;
  bool isOfAmbiguousTime(const Known &known) const;
  void doubtByTrack(int64_t time_ns, Faults *faults);
  void contradict(Faults by, Faults *faults);
  void checkHandedness(const Deadline &deadline, Faults *faults, Work *work);
  Hints hints() const;
  void observe();
  double surenessOf(Faults faults) const;
  void learn(int64_t time_ns, LocalizerResult *result);

  LocalizerConfig config_;
  DepthReader depth_readers_[kMostDepthCameras];
  FrontEnd front_;
  PoseFinder finder_;
  DepthCalibrator calibrator_;
  Tracker tracker_;
  Trail trail_;
  Fusion fusion_;
  Consistency consistency_;
  OdometryCheck odometry_;
  TravelCheck travel_;
  DistanceCheck distances_;
  RecentAmbiguity ambiguity_;
  // Of this frame.
  bool was_ambiguous_ = false;  // by what it shows, whatever the track says
  BetweenImages between_;
  double confidence_of_matches_ = 0;  // of the pose, but for what is not known of the way between images
};

}  // namespace sphc
