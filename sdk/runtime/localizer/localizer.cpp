#include "runtime/localizer/localizer.h"

#include "runtime/localizer/doubt.h"
#include "runtime/localizer/rig_of_frame.h"
#include "runtime/localizer/tuning.h"
#include "runtime/stages/pose/confidence.h"

namespace sphc {

using namespace tuning;

namespace {

DepthReaderConfig readerConfig(const RigDepthCamera &depth) {
  return {depth.camera, depth.sensor.unit_m, depth.layout, depth.least_amplitude};
}

void fillAnswer(const Hypothesis &best, LocalizerResult *result) {
  result->outcome = best.outcome;
  result->matches = static_cast<uint32_t>(best.matched.matches().size());
  result->inliers = best.estimate.inliers;
  result->frames = best.frames;
  result->guided = best.guided;
  if (!best.isLocalized()) return;
  result->camera_from_map = best.estimate.camera_from_map;
  result->covariance = statedCovariance(best.estimate);
  result->confidence = confidenceOf(result->covariance);
}

}  // namespace

Localizer::Localizer() = default;  // here it is compiled for size

void Localizer::layout(const LocalizerConfig &config, Arena &state, Arena &scratch, Localizer *localizer) {
  for (size_t i = 0; i < config.depth.size(); ++i)
    DepthReader::layout(readerConfig(config.depth[i]), state, scratch,
                        localizer ? &localizer->depth_readers_[i] : nullptr);
  FrontEnd::layout(config, state, scratch, localizer ? &localizer->front_ : nullptr);
  Fusion::layout(config.max_keypoints, state, localizer ? &localizer->fusion_ : nullptr);
  PoseFinder::layout(config, state, scratch, localizer ? &localizer->finder_ : nullptr);
  Consistency::layout(state, scratch, localizer ? &localizer->consistency_ : nullptr);
  if (config.tracks) DistanceCheck::layout(state, localizer ? &localizer->distances_ : nullptr);
}

void Localizer::init(const LocalizerConfig &config) {
  config_ = config;
  for (size_t i = 0; i < config.depth.size(); ++i) depth_readers_[i].init(readerConfig(config.depth[i]));
  front_.init(config);
  finder_.init(config);
  calibrator_.init(config.depth_prior);
  const RigDepthCamera &first = config.depth[0];
  consistency_.init({config.color_camera, first.camera, first.sensor, config.tracks, first.layout.is_range});
  distances_.reset();
}

bool Localizer::setMap(uint32_t id, const MapView &map) {
  const uint32_t slot = finder_.maps().set(id, map);
  if (slot == kNoMap) return false;
  fusion_.forget(slot);  // its matches name points of what was there
  distances_.forget(slot);
  return true;
}

bool Localizer::removeMap(uint32_t id) {
  const uint32_t slot = maps().slotOf(id);
  if (slot == kNoMap) return false;
  finder_.maps().remove(slot);
  fusion_.forget(slot);
  tracker_.forget(slot);
  odometry_.forget(slot);
  travel_.forget(slot);
  distances_.forget(slot);
  return true;
}

bool Localizer::placeMap(uint32_t id, const Placement &placement) {
  const uint32_t slot = maps().slotOf(id);
  if (slot != kNoMap) finder_.maps().place(slot, placement);
  return slot != kNoMap;
}

void Localizer::reset() {
  tracker_.reset();
  fusion_.clear();
  consistency_.reset();
  odometry_.reset();
  travel_.reset();
  distances_.reset();
  ambiguity_.reset();
}

double Localizer::confidenceWithin(const Matrix6 &covariance, double translation_m, double rotation_rad) {
  return confidenceOf(covariance, {translation_m, rotation_rad});
}

LocalizerResult Localizer::process(const FrameInput &frame) {
  const int64_t begin = config_.clock.now();
  const Deadline deadline = deadlineFrom(begin, frame.time_limit_ns);
  follow(frame);
  Prediction expected;
  const bool is_expected = expectedPose(frame.known, tracker(), kMostConeInHasteRad, &expected);
  front_.extract(frame.color, frame.further,
                 deadline.afterShare(is_expected ? kFeaturesNearShare : kFeaturesShare));
  const int64_t extracted = config_.clock.now();
  LocalizerResult result = locateShown(frame, deadline, extracted);
  result.times.features_ns = elapsedNs(begin, extracted);
  return result;
}

void Localizer::extract(const FrameInput &frame, FrameFeatures *features) {
  const int64_t begin = config_.clock.now();
  front_.extractInto(frame.color, frame.further, deadlineFrom(begin, frame.time_limit_ns), features);
  features->took_ns = elapsedNs(begin, config_.clock.now());
}

LocalizerResult Localizer::locate(const FrameInput &frame, const FrameFeatures &features) {
  const int64_t begin = config_.clock.now();
  follow(frame);
  front_.show(features);
  LocalizerResult result = locateShown(frame, deadlineFrom(begin, frame.time_limit_ns), begin);
  result.times.features_ns = features.took_ns;
  return result;
}

// Brings what earlier frames told to the time of this one.
void Localizer::follow(const FrameInput &frame) {
  if (!config_.tracks) return;
  odometry_.advance(frame.color_time_ns);
  const bool is_believed = frame.known.has_odometry && !odometry_.disagrees();
  Odometry odometry = frame.known.odometry;
  if (travel_.wasScaled()) odometry.scale_sigma = 1;
  tracker_.advance(frame.color_time_ns, is_believed ? &odometry : nullptr);
  ambiguity_.advance(frame.color_time_ns);
  fusion_.advance(tracker_);
}

// From the features of the front end to the answer; `begin_ns` is when that began.
LocalizerResult Localizer::locateShown(const FrameInput &frame, const Deadline &deadline, int64_t begin_ns) {
  LocalizerResult result;
  result.depth = calibrator_.current();
  const RigOfFrame rig = rigOfFrame(config_, frame, front_.seenCameras(), tracker(), rateAt(frame.color_time_ns));
  between_ = rig.between;
  const DepthImages depth = read(frame.depth);
  const DepthPlace &first_depth = rig.cameras.depth[0];
  consistency_.setCameras(rig.cameras.color_camera, first_depth.camera);
  const Deadline lifted_by = deadline.afterShare(kLiftShare);
  config_.parallel.both([&] { front_.lift(depth, rig.cameras, lifted_by); },
                        [&] {
                          result.faults = consistency_.look({front_.gray(), depth[0], first_depth.color_from_depth,
                                                             frame.color_time_ns, frame.depth[0].time_ns,
                                                             rig.between_first_depth.areApart(), hidesEdges});
                        });
  const int64_t aligned = config_.clock.now();
  Work work;
  answer(frame, deadline, &result.faults, &work);
  fillAnswer(best(), &result);
  if (best().tried) result.map_id = maps().idOf(best().map);
  if (best().isLocalized()) finder_.ranking().markAnswer(best().estimate.camera_from_map, result.map_id);
  result.cuts = (front_.wasCut() ? kCutFeatures : Cuts{0}) | work.cuts;
  if (!best().isLocalized()) result.hints = hints();
  result.confidence = doubted(result.confidence, best(), result.faults, consistency_.isDoubtful());
  observe();
  learn(frame.color_time_ns, &result);
  result.keypoints = front_.keypointCount();
  result.lifted = front_.liftedCount();
  result.samples = work.samples;
  if (config_.tracks) result.state = tracker_.state();
  const uint64_t located_ns = elapsedNs(aligned, config_.clock.now());
  result.times = {0, elapsedNs(begin_ns, aligned), work.match_ns,
                  located_ns > work.match_ns ? located_ns - work.match_ns : 0};
  return result;
}

bool Localizer::predict(int64_t time_ns, MovedPose *moved) const {
  Motion motion;
  return tracker_.motion(trail_, &motion) && moveTo(time_ns, motion, moved);
}

// While rows are exposed: by odometry, or else from pose to pose.
CameraRate Localizer::rateAt(int64_t time_ns) const {
  CameraRate rate;
  MovedPose moved;
  if (!config_.tracks || !config_.hasRollingShutter()) return rate;
  if (tracker_.rate(&rate)) return ofAHead(rate);
  if (!predict(time_ns, &moved)) return rate;
  const Matrix3 &camera_from_map = moved.camera_from_map.rotation;
  return ofAHead({-(camera_from_map * moved.angular_velocity_in_map_rad_s),
                  -(camera_from_map * moved.velocity_in_map_m_s), moved.angular_velocity_sigma_rad_s,
                  moved.velocity_sigma_m_s});
}

DepthImages Localizer::read(const DepthViews &views) {
  DepthImages images;
  for (size_t i = 0; i < views.size(); ++i)
    images.push(views[i].depth.data ? depth_readers_[i].read(views[i].depth, views[i].amplitude)
                                    : ImageView<uint16_t>());
  return images;
}

Deadline Localizer::deadlineFrom(int64_t begin_ns, int64_t limit_ns) const {
  return limit_ns ? Deadline::after(config_.clock, begin_ns, limit_ns).afterShare(kUntilEnd) : Deadline();
}

// Makes best() what the frame is answered with: by what can be believed of it.
void Localizer::answer(const FrameInput &frame, const Deadline &deadline, Faults *faults, Work *work) {
  finder_.begin({&front_, &fusion_, tracker(), calibrator_.current(), between_.areApart()});
  was_ambiguous_ = false;
  if (*faults & kContradictions)
    best().outcome = Outcome::kContradiction;
  else
    findPose(frame.known, deadline, faults, work);
  if (config_.tracks) compareWithTrack(frame, faults);
  if (isOfAmbiguousTime(frame.known)) best().has_near_rival = true;
}

void Localizer::findPose(const Known &known, const Deadline &deadline, Faults *faults, Work *work) {
  finder_.find(known, deadline, work);
  if (known.prior.has_up) checkVertical(known, deadline, faults, work);
  checkHandedness(deadline, faults, work);
  if (best().isLocalized()) {
    if (!between_.areApart()) checkFocalLength(deadline, faults, work);
    confidence_of_matches_ = confidenceOf(statedCovariance(best().estimate));
    widen(between_.turnSigma(), between_.shiftSigma(), &best().estimate);
  }
  if (isBeyondPrior(calibrator_.current(), config_.depth_prior)) *faults |= kDepthBias;
  if (wouldMakeTrackSure(known, *faults)) finder_.confirm(deadline, work);
  was_ambiguous_ = best().is_ambiguous && !best().isLocalized();
}

// A wrong vertical may show in the pose, and may be why there is none.
void Localizer::checkVertical(const Known &known, const Deadline &deadline, Faults *faults, Work *work) {
  const PosePrior nothing;
  Known rest = known;
  rest.prior.has_up = false;
  for (const bool is_again : {false, true}) {
    const Vertical vertical = compareVertical(known, best(), finder_.queryFor(nothing, Deadline()),
                                              finder_.parameters().min_inliers, &finder_.estimator());
    if (vertical == Vertical::kDisagrees) *faults |= kVerticalDisagrees;
    const bool ends = vertical == Vertical::kAgrees || (vertical == Vertical::kUnknown && deadline.passed());
    if (is_again || ends) return;
    finder_.find(rest, deadline, work);
  }
}

// A frame may lack this step for its deadline.
void Localizer::checkFocalLength(const Deadline &deadline, Faults *faults, Work *work) {
  if (deadline.passed()) work->cuts |= kCutVerification;
  const FocalLength focal = compareFocalLength(best(), calibrator_.current(), deadline);
  if (focal == FocalLength::kDisagrees) *faults |= kFocalDisagrees;
  best().has_doubtful_focal = focal == FocalLength::kDoubtful;
}

// With what earlier frames said of odometry, of the points and of the camera.  Of every frame: what goes on from
// frame to frame must see each step.
void Localizer::compareWithTrack(const FrameInput &frame, Faults *faults) {
  odometry_.look(frame.known, best());
  if (odometry_.disagrees()) *faults |= kOdometryDisagrees;
  if (best().isLocalized()) doubtByTrack(frame.color_time_ns, faults);
  if (travel_.isScaled(frame.known, tracker_, best()) && !odometry_.disagrees()) *faults |= kDepthScale;
}

// Where a pose is expected nothing of the rest of the map is held against it, so a track that began in the wrong
// one of two rooms would become sure of itself.
bool Localizer::wouldMakeTrackSure(const Known &known, Faults faults) const {
  return config_.tracks && best().isLocalized() && best().guided && !isNarrow(known) && !tracker_.isSure() &&
         surenessOf(faults) > kSureOfTrack;
}

// Where what is seen repeats, one frame of many shows no rival by chance.
bool Localizer::isOfAmbiguousTime(const Known &known) const {
  return config_.tracks && best().isLocalized() && !isNarrow(known) && !(best().guided && tracker_.isSure()) &&
         ambiguity_.isSeen();
}

// By what earlier frames said of the points, and of the camera.
void Localizer::doubtByTrack(int64_t time_ns, Faults *faults) {
  if (distances_.disagrees(time_ns, best(), finder_.estimator())) return contradict(kDistancesDisagree, faults);
  if (tracker_.vetoes(best().map, best().estimate)) best().doubtForRival();
}

// Takes the pose away.
void Localizer::contradict(Faults by, Faults *faults) {
  *faults |= by;
  finder_.ranking().clear();
  best().outcome = Outcome::kContradiction;
}

// Takes the pose of a mirror image away, and names it.  The last step, which a frame may lack for its deadline.  A
// pose of the whole map may be one of a mirror image if it rests on one spot; a frame that has none if much of it
// looks like the map.
void Localizer::checkHandedness(const Deadline &deadline, Faults *faults, Work *work) {
  if (!best().tried || (best().isLocalized() && best().guided)) return;
  Spread frame;
  if (best().hasPose()) frame = spreadOf(best().matched.ofThisFrame(), best().estimate, finder_.estimator());
  const bool is_asked = best().isLocalized() ? mayBeMirrored(frame)
                                             : finder_.clear() > kLeastClearOfMirrored * front_.keypointCount();
  if (!is_asked) return;
  if (deadline.passed()) {
    work->cuts |= kCutVerification;
    return;
  }
  const Hypothesis &found = finder_.findMirrored(deadline, work);
  Spread mirrored;
  if (found.hasPose() && found.evidence.log_chance_first < kMostLogChance)
    mirrored = spreadOf(found.matched.ofThisFrame(), found.estimate, finder_.estimator());
  switch (handednessOf(frame, mirrored)) {
    case Handedness::kKept:
      break;
    case Handedness::kUnclear:
      if (best().isLocalized()) best().doubtForRival();
      break;
    case Handedness::kChanged:
      contradict(kMirrored, faults);
  }
}

Hints Localizer::hints() const {
  FrameEvidence frame;
  frame.image = qualityOf(front_.gray(), config_.color_camera.focal());
  frame.keypoints = front_.keypointCount();
  frame.salient = countSalient(front_.keypoints(), frame.image.noise);
  frame.lifted = front_.liftedCount();
  frame.was_cut = front_.wasCut();
  frame.was_asked = finder_.wasAsked();
  frame.clear = finder_.clear();
  return hintsOf(frame, best());
}

// Tells of each keypoint what became of it.
void Localizer::observe() {
  for (const Match &match : best().matched.matches()) {
    Observation &observation = front_.observationOf(match.query);
    observation.point_index = match.point_index;
    observation.matched = true;
    const Correspondence c = correspondenceOf(match, front_, maps().view(best().map));
    observation.inlier = best().isLocalized() && finder_.estimator().isInlier(c, best().estimate);
  }
}

// How sure a track may be of the pose: images that are hardly apart make it less exact, but no other one.
double Localizer::surenessOf(Faults faults) const {
  const double confidence =
      between_.areApart() ? confidenceOf(statedCovariance(best().estimate)) : confidence_of_matches_;
  return doubted(confidence, best(), faults, consistency_.isDoubtful());
}

void Localizer::learn(int64_t time_ns, LocalizerResult *result) {
  if (best().isLocalized()) {
    if (!between_.areApart()) calibrator_.learn(best().estimate);
    fusion_.clear();
    if (!config_.tracks) return;
    if (!between_.areApart()) distances_.keep(best(), finder_.estimator());
    tracker_.goOver(best().map, maps());
    result->jump = tracker_.accept(best().map, best().estimate, surenessOf(result->faults),
                                   (result->faults & kDoubts) != 0, between_.shiftSigma());
    trail_.add(time_ns, result->camera_from_map, result->covariance);
  } else if (config_.tracks) {
    tracker_.miss();
  }
  if (config_.tracks) ambiguity_.add(was_ambiguous_);
}

}  // namespace sphc
