#include "runtime/localizer/localizer.h"

#include <algorithm>
#include <utility>

#include "runtime/localizer/doubt.h"
#include "runtime/localizer/rig_of_frame.h"
#include "runtime/localizer/tuning.h"
#include "runtime/stages/pose/confidence.h"

namespace sphc {

using namespace tuning;

namespace {

bool isWhereExpected(const Rigid &found, const Prediction &expected) {
  return areNear(found, expected.camera_from_map,
                 boundsOfNoJump(expected.rotation_sigma_rad, expected.translation_sigma_m));
}

PosePrior priorFor(const Known &known, uint32_t map) { return known.map == map ? known.prior : PosePrior(); }

DepthReaderConfig readerConfig(const RigDepthCamera &depth) {
  return {depth.camera, depth.sensor.unit_m, depth.layout, depth.least_amplitude};
}

// Where nothing localizes, the last global search of the likeliest map stands for the frame.
bool replaces(const Hypothesis &candidate, const Hypothesis &best) {
  return candidate.isLocalized() || !best.tried || best.guided || candidate.map == best.map;
}

// Where not all keypoints were asked: few inliers that chance nearly explains were wrong.
bool isClear(const Hypothesis &found, uint32_t min_inliers) {
  return found.estimate.inliers >= kTimesInliersUnasked * min_inliers &&
         found.evidence.log_chance_first < kMostLogChance;
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
  const uint32_t n = config.max_keypoints;
  EstimatorConfig estimator;
  estimator.capacity = 2 * n;  // this frame's correspondences and those of earlier ones
  estimator.max_iterations = config.search.max_iterations;
  estimator.has_centres = config.further.size() > 0;

  for (size_t i = 0; i < config.depth.size(); ++i)
    DepthReader::layout(readerConfig(config.depth[i]), state, scratch,
                        localizer ? &localizer->depth_readers_[i] : nullptr);
  FrontEnd::layout(config, state, scratch, localizer ? &localizer->front_ : nullptr);
  Fusion::layout(n, state, localizer ? &localizer->fusion_ : nullptr);
  Search::layout(config, state, scratch, localizer ? &localizer->search_ : nullptr);
  MatchSet::layout(n, scratch, localizer ? &localizer->best_.matched : nullptr);
  MatchSet::layout(n, scratch, localizer ? &localizer->candidate_.matched : nullptr);
  MatchSet::layout(n, scratch, localizer ? &localizer->rival_.matched : nullptr);
  Repetition::layout(n, config.parallel, scratch, localizer ? &localizer->repetition_ : nullptr);
  PoseEstimator::layout(estimator, scratch, localizer ? &localizer->estimator_ : nullptr);
  Consistency::layout(state, scratch, localizer ? &localizer->consistency_ : nullptr);
  if (config.tracks) DistanceCheck::layout(state, localizer ? &localizer->distances_ : nullptr);
}

void Localizer::init(const LocalizerConfig &config) {
  config_ = config;
  for (size_t i = 0; i < config.depth.size(); ++i) depth_readers_[i].init(readerConfig(config.depth[i]));
  front_.init(config);
  search_.init(config);
  repetition_.setParallel(config.parallel);
  calibrator_.init(config.depth_prior);
  consistency_.init({config.color_camera, config.depth[0].camera, config.depth[0].sensor, config.tracks});
  distances_.reset();
}

bool Localizer::setMap(uint32_t id, const MapView &map) {
  const uint32_t slot = search_.maps().set(id, map);
  if (slot == kNoMap) return false;
  fusion_.forget(slot);  // its matches name points of what was there
  distances_.forget(slot);
  return true;
}

bool Localizer::removeMap(uint32_t id) {
  const uint32_t slot = maps().slotOf(id);
  if (slot == kNoMap) return false;
  search_.maps().remove(slot);
  fusion_.forget(slot);
  tracker_.forget(slot);
  odometry_.forget(slot);
  travel_.forget(slot);
  distances_.forget(slot);
  return true;
}

bool Localizer::placeMap(uint32_t id, const Placement &placement) {
  const uint32_t slot = maps().slotOf(id);
  if (slot != kNoMap) search_.maps().place(slot, placement);
  return slot != kNoMap;
}

void Localizer::setParameters(const SearchParameters &parameters) {
  config_.search = parameters;
  search_.setParameters(parameters);
  estimator_.setMaxIterations(parameters.max_iterations);
}

void Localizer::reset() {
  tracker_.reset();
  fusion_.clear();
  consistency_.reset();
  odometry_.reset();
  travel_.reset();
  distances_.reset();
}

double Localizer::confidenceWithin(const Matrix6 &covariance, double translation_m, double rotation_rad) {
  return confidenceOf(covariance, {translation_m, rotation_rad});
}

LocalizerResult Localizer::process(const FrameInput &frame) {
  const int64_t begin = config_.clock.now();
  const Deadline deadline = deadlineFrom(begin, frame.time_limit_ns);
  follow(frame);
  Prediction expected;
  const bool is_expected = expects(frame.known, kMostConeInHasteRad, &expected);
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
  const bool is_believed = frame.known.has_odometry && !odometry_.disagrees();
  tracker_.advance(frame.color_time_ns, is_believed ? &frame.known.odometry : nullptr);
  fusion_.advance(tracker_);
}

// From the features of the front end to the answer; `begin_ns` is when that began.
LocalizerResult Localizer::locateShown(const FrameInput &frame, const Deadline &deadline, int64_t begin_ns) {
  LocalizerResult result;
  result.depth = calibrator_.current();
  const RigOfFrame rig = rigOfFrame(config_, frame, config_.tracks ? &tracker_ : nullptr);
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
  fillAnswer(best_, &result);
  if (best_.tried) result.map_id = maps().idOf(best_.map);
  if (best_.isLocalized()) ranking_.markAnswer(best_.estimate.camera_from_map, result.map_id);
  result.cuts = (front_.wasCut() ? kCutFeatures : Cuts{0}) | work.cuts;
  if (!best_.isLocalized()) result.hints = hints();
  result.confidence = doubted(result.confidence, result.inliers, result.faults, consistency_.isDoubtful());
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

// Makes best_ what the frame is answered with: by what can be believed of it.
void Localizer::answer(const FrameInput &frame, const Deadline &deadline, Faults *faults, Work *work) {
  const Known &known = frame.known;
  was_asked_ = false;
  clear_ = 0;
  ranking_.clear();
  if (*faults & kContradictions) {
    best_.challenge({});
    best_.outcome = Outcome::kContradiction;
    return;
  }
  locate(known, deadline, work);
  if (known.prior.has_up) checkVertical(known, deadline, faults, work);
  checkHandedness(deadline, faults, work);
  if (best_.isLocalized()) {
    if (!between_.areApart()) checkFocalLength(deadline, faults, work);
    confidence_of_matches_ = confidenceOf(statedCovariance(best_.estimate));
    widen(between_.turn_sigma_rad, between_.shift_sigma_m, &best_.estimate);
  }
  if (config_.tracks) compareWithTrack(frame, faults);
  if (isBeyondPrior(calibrator_.current(), config_.depth_prior)) *faults |= kDepthBias;
}

// A wrong vertical may show in the pose, and may be why there is none.
void Localizer::checkVertical(const Known &known, const Deadline &deadline, Faults *faults, Work *work) {
  const PosePrior nothing;
  Known rest = known;
  rest.prior.has_up = false;
  for (const bool is_again : {false, true}) {
    const Vertical vertical =
        compareVertical(known, best_, queryFor(nothing, Deadline()), config_.search.min_inliers, &estimator_);
    if (vertical == Vertical::kDisagrees) *faults |= kVerticalDisagrees;
    const bool ends = vertical == Vertical::kAgrees || (vertical == Vertical::kUnknown && deadline.passed());
    if (is_again || ends) return;
    ranking_.clear();  // those poses stood on it
    locate(rest, deadline, work);
  }
}

// A frame may lack this step for its deadline.
void Localizer::checkFocalLength(const Deadline &deadline, Faults *faults, Work *work) const {
  if (deadline.passed()) work->cuts |= kCutVerification;
  if (isOfOtherFocalLength(best_, calibrator_.current(), deadline)) *faults |= kFocalDisagrees;
}

// With what earlier frames said of odometry, of the points and of the camera.
void Localizer::compareWithTrack(const FrameInput &frame, Faults *faults) {
  odometry_.look(frame.color_time_ns, frame.known, best_);
  if (odometry_.disagrees()) *faults |= kOdometryDisagrees;
  if (best_.isLocalized()) doubtByTrack(frame.color_time_ns, faults);
  if (travel_.isScaled(frame.known, tracker_, best_) && !odometry_.disagrees()) *faults |= kDepthScale;
}

// By what earlier frames said of the points, and of the camera.
void Localizer::doubtByTrack(int64_t time_ns, Faults *faults) {
  if (distances_.disagrees(time_ns, best_, estimator_)) return contradict(kDistancesDisagree, faults);
  if (tracker_.vetoes(best_.map, best_.estimate)) best_.doubtForRival();
}

// Takes the pose away.
void Localizer::contradict(Faults by, Faults *faults) {
  *faults |= by;
  ranking_.clear();
  best_.outcome = Outcome::kContradiction;
}

// Takes the pose of a mirror image away, and names it.  The last step, which a frame may lack for its deadline.  A
// pose of the whole map may be one of a mirror image if it rests on one spot; a frame that has none if much of it
// looks like the map.
void Localizer::checkHandedness(const Deadline &deadline, Faults *faults, Work *work) {
  if (!best_.tried || (best_.isLocalized() && best_.guided)) return;
  Spread frame;
  if (best_.hasPose()) frame = spreadOf(best_.matched.ofThisFrame(), best_.estimate, estimator_);
  const bool is_asked =
      best_.isLocalized() ? mayBeMirrored(frame) : clear_ > kLeastClearOfMirrored * front_.keypointCount();
  if (!is_asked) return;
  if (deadline.passed()) {
    work->cuts |= kCutVerification;
    return;
  }
  findPoseOfMirrored(deadline, work);
  Spread mirrored;
  if (candidate_.hasPose() && candidate_.evidence.log_chance_first < kMostLogChance)
    mirrored = spreadOf(candidate_.matched.ofThisFrame(), candidate_.estimate, estimator_);
  switch (handednessOf(frame, mirrored)) {
    case Handedness::kKept:
      break;
    case Handedness::kUnclear:
      if (best_.isLocalized()) best_.doubtForRival();
      break;
    case Handedness::kChanged:
      contradict(kMirrored, faults);
  }
}

// Makes candidate_ what the mirror image of the frame shows in the map of best_.
void Localizer::findPoseOfMirrored(const Deadline &deadline, Work *work) {
  Ranking of_mirrored;  // poses that the frame itself does not have
  front_.mirror();
  const PosePrior nothing;
  const uint32_t all = front_.keypointCount();
  const PoseTask task = {search_.ask(front_, best_.map, all, config_.search.probes, work),
                         {},
                         queryFor(nothing, deadline),
                         4 * kPi,
                         {kConesOfSearchedPose, 2}};
  candidate_.begin(best_.map);
  search_.matchEverywhere(task.question, all, deadline.afterShare(kMatchShare), &candidate_.matched, work);
  verification(config_.search.min_inliers, work, &of_mirrored).findUnverifiedPose(task, &candidate_);
  front_.mirror();
}

// Makes best_ what is found with all that is known.
void Localizer::locate(const Known &known, const Deadline &deadline, Work *work) {
  best_.challenge({});
  const bool few = front_.keypointCount() < kFewestKeypoints;
  if (few || front_.liftedCount() < kFewestLifted) {
    best_.outcome = front_.wasCut() ? Outcome::kDeadline : few ? Outcome::kFewKeypoints : Outcome::kFewDepths;
    return;
  }
  Prediction expected;
  if (expects(known, front_.wasCut() ? kMostConeInHasteRad : kMostConeRad, &expected))
    searchNear(known, expected, deadline, work);
  if (!isDone(deadline, work)) searchEverywhere(known, deadline, work);
  if (!best_.isLocalized() && work->cuts) best_.outcome = Outcome::kDeadline;
}

bool Localizer::expects(const Known &known, double most_cone_rad, Prediction *expected) const {
  return expectedPose(known, config_.tracks ? &tracker_ : nullptr, most_cone_rad, expected);
}

void Localizer::searchNear(const Known &known, const Prediction &expected, const Deadline &deadline, Work *work) {
  PosePrior prior = priorFor(known, expected.map);
  prior.has_pose = true;
  prior.camera_from_map = expected.camera_from_map;
  prior.rotation_sigma_rad = expected.rotation_sigma_rad;
  prior.translation_sigma_m = expected.translation_sigma_m;
  candidate_.begin(expected.map);
  candidate_.guided = true;
  const double cone_rad = coneOf(expected);
  // matching near a direction has probes of its own
  const Search::Question question = search_.ask(front_, expected.map, front_.liftedCount(), 1, work);
  const Deadline own = deadline.afterShare(kNearShare);
  search_.matchNear(question, expected.camera_from_map, cone_rad, {}, own.afterShare(kMatchShare),
                    &candidate_.matched, work);
  solve({question, {}, queryFor(prior, own), solidAngleOf(cone_rad), {kConesOfExpectedPose, 1}}, work);
  // A pose elsewhere lacks what a search of the whole map would hold against it.
  if (candidate_.isLocalized() && !isWhereExpected(candidate_.estimate.camera_from_map, expected))
    candidate_.outcome = Outcome::kUncertain;
  propose();
}

void Localizer::searchEverywhere(const Known &known, const Deadline &deadline, Work *work) {
  const MapOrder order = search_.rankMaps(front_, deadline.afterShare(kMatchShare), work);
  if (order.size() == 0) return;  // there is no map
  const bool fuses = config_.tracks && tracker_.hasOdometry();
  const uint32_t remembered = fusion_.mapToRemember(order);
  Prediction expected, there;
  const bool is_expected = expects(known, kMostConeRad, &expected);
  for (uint32_t map : order) {
    if (is_expected && carriedOver(expected, map, maps(), &there) && coneOf(there) < kMostConeRad) {
      searchNear(known, there, deadline, work);
      if (isDone(deadline, work)) return;
    }
    PosePrior prior = priorFor(known, map);
    if (isNarrow(known)) prior.has_pose = false;  // a search there has failed
    searchMap(map, fuses && map == remembered, queryFor(prior, deadline), work);
    if (isDone(deadline, work)) return;
  }
}

// By the strongest keypoints; where they leave a doubt by all; where these show too little, by those of earlier
// frames too; and where all that leads to no pose, by a looser ratio test.
void Localizer::searchMap(uint32_t map, bool remembers, const PoseQuery &query, Work *work) {
  const uint32_t lifted = front_.liftedCount(), all = front_.keypointCount();
  const uint32_t probes =
      search_.probesWithin(std::min(lifted, kStrongest), query.deadline.afterShare(kMatchShare), work);
  PoseTask task = {search_.ask(front_, map, all, probes, work), {}, query, 4 * kPi, {kConesOfSearchedPose, 2}};
  Prediction expected;
  if (tracker_.predict(&expected) && expected.map == map) task.expected = &expected.camera_from_map;
  if (config_.search.probes > 0 && lifted > kStrongest && searchMapByStrongest(map, task, work)) return propose();
  candidate_.begin(map);
  search_.matchEverywhere(task.question, all, query.deadline.afterShare(kMatchShare), &candidate_.matched, work);
  was_asked_ = work->cuts == 0;
  clear_ = std::max(clear_, countClear(candidate_.matched.matches()));
  task.rays = search_.raysOf(front_, candidate_.matched);
  const bool has_others = remembers && !between_.areApart() && fusion_.remember(map, candidate_.matched);
  solve(task, work);
  bool has_pose = candidate_.hasPose();
  propose();
  if (isDone(query.deadline, work)) return;
  if (has_others) {
    candidate_.begin(map, fusion_.frames());
    fusion_.addTo(*task.question.map, &candidate_.matched);
    solve(task, work);
    has_pose = has_pose || candidate_.hasPose();
    propose();
  }
  if (!has_pose && !isDone(query.deadline, work)) searchMapLoosely(map, task, work);
}

// True where that ends the search.  In guided re-matching all keypoints take part.
bool Localizer::searchMapByStrongest(uint32_t map, const PoseTask &task, Work *work) {
  const Deadline &deadline = task.query.deadline;
  const uint64_t left_ns = deadline.leftNs();
  candidate_.begin(map);
  search_.matchEverywhere(task.question, kStrongest, deadline.afterShare(kMatchShare), &candidate_.matched, work);
  solve(task, work);
  if (!candidate_.isLocalized()) return deadline.passed();
  if (candidate_.evidence.log_chance_first < kBeyondDoubt) return true;
  // A search by all takes longer than this one did.
  if (!deadline.isSet() || 2 * deadline.leftNs() > left_ns) return false;
  work->cuts |= kCutSearch;
  if (!isClear(candidate_, config_.search.min_inliers)) candidate_.outcome = Outcome::kUncertain;
  return true;
}

// What does not localize leaves the frame as the strict test shows it.
void Localizer::searchMapLoosely(uint32_t map, const PoseTask &task, Work *work) {
  candidate_.begin(map);
  verification(kTimesInliersOfLooser * config_.search.min_inliers, work, &ranking_)
      .findPoseLoosely(task, &candidate_, &rival_);
  if (candidate_.isLocalized()) propose();
}

// Finds the pose that the candidate's matches speak for.
void Localizer::solve(const PoseTask &task, Work *work) {
  verification(config_.search.min_inliers, work, &ranking_).findPose(task, &candidate_, &rival_);
}

Verification Localizer::verification(uint32_t min_inliers, Work *work, Ranking *ranking) {
  return Verification(&search_, &estimator_, &repetition_, &fusion_, min_inliers, config_.tracks, work, ranking);
}

void Localizer::propose() {
  if (replaces(candidate_, best_)) swap(candidate_, best_);
}

// `prior` is borrowed.
PoseQuery Localizer::queryFor(const PosePrior &prior, const Deadline &deadline) const {
  PoseQuery query;
  query.prior = &prior;
  query.depth = calibrator_.current();
  query.seed = config_.seed;
  query.deadline = deadline;
  return query;
}

// Is the frame localized, or no time left for another search?
bool Localizer::isDone(const Deadline &deadline, Work *work) const {
  if (best_.isLocalized()) return true;
  if (!deadline.passed()) return false;
  work->cuts |= kCutSearch;
  return true;
}

Hints Localizer::hints() const {
  FrameEvidence frame;
  frame.image = qualityOf(front_.gray(), config_.color_camera.focal());
  frame.keypoints = front_.keypointCount();
  frame.salient = countSalient(front_.keypoints(), frame.image.noise);
  frame.lifted = front_.liftedCount();
  frame.was_cut = front_.wasCut();
  frame.was_asked = was_asked_;
  frame.clear = clear_;
  return hintsOf(frame, best_);
}

// Tells of each keypoint what became of it.
void Localizer::observe() {
  for (const Match &match : best_.matched.matches()) {
    Observation &observation = front_.observationOf(match.query);
    observation.point_index = match.point_index;
    observation.matched = true;
    const Correspondence c = correspondenceOf(match, front_, search_.map(best_.map));
    observation.inlier = best_.isLocalized() && estimator_.isInlier(c, best_.estimate);
  }
}

// How sure a track may be of the pose: images that are hardly apart make it less exact, but no other one.
double Localizer::surenessOf(const LocalizerResult &result) const {
  if (between_.areApart()) return result.confidence;
  return doubted(confidence_of_matches_, result.inliers, result.faults, consistency_.isDoubtful());
}

void Localizer::learn(int64_t time_ns, LocalizerResult *result) {
  if (best_.isLocalized()) {
    if (!between_.areApart()) calibrator_.learn(best_.estimate);
    fusion_.clear();
    if (!config_.tracks) return;
    if (!between_.areApart()) distances_.keep(best_, estimator_);
    tracker_.goOver(best_.map, maps());
    result->jump = tracker_.accept(best_.map, best_.estimate, surenessOf(*result), between_.shift_sigma_m);
    trail_.add(time_ns, result->camera_from_map, result->covariance);
  } else if (config_.tracks) {
    tracker_.miss();
  }
}

}  // namespace sphc
