#include "runtime/localizer/localizer.h"

#include <algorithm>

#include "runtime/base/message.h"
#include "runtime/stages/pose/confidence.h"

namespace sphc {
namespace {

constexpr double degrees(double value) { return value * kPi / 180; }

constexpr uint32_t kFewestKeypoints = 32, kFewestLifted = 16, kFewestMatches = 6;
// Half angles of the caps in which a second look is taken, once there is a pose; the first is generous towards it.
constexpr double kCapsOfFirstPose[] = {degrees(4), degrees(2.5)}, kCapsOfExpectedPose[] = {degrees(2.5)};
// Of the first look where a pose is expected: so many sigmas, but no less than a cap in which agreement still
// proves something, and beyond the most the whole map is as good.
constexpr double kLeastCap = degrees(2.5), kCapSigmas = 3, kMostCap = degrees(10);
constexpr double kTypicalDepth_m = 2;
// A pose whose camera centre would be so many times vaguer without its heaviest matches rests on them.
constexpr double kRestsOnFew = 1.8;
constexpr uint32_t kInliersALever = 12, kInliersBeyondContest = 60;
static_assert(1 + kInliersBeyondContest / kInliersALever <= kMostLevers, "so many may be left out");
// Of a flat scene's two poses the right one gained 1.6 times what the other did, or more, on real recordings.
constexpr double kNearlyAsGood = 0.8, kSamePoseRad = degrees(5);
constexpr int kPaperIterations = 25;
// A second look leans towards the pose it was taken with: without all matches the first must leave no doubt.
constexpr double kBeyondDoubt = -30;  // log of the chance
constexpr uint32_t kStrongest = 200;  // keypoints with depth that are asked first: they often tell the pose already
// Which map?  Of so many keypoints, how many find their like in each; the best maps are then looked into.
constexpr uint32_t kVoters = 200, kVoteProbes = 4, kMapsTried = 3;

double solidAngle(double cap_rad) {
  double sine, cosine;
  sinCos(cap_rad, &sine, &cosine);
  return 2 * kPi * (1 - cosine);
}

// Until a second look has judged a pose that was found.
sphc_outcome outcomeOf(PoseEnding ending) {
  if (ending == PoseEnding::kFewCorrespondences) return SPHC_OUTCOME_FEW_MATCHES;
  return ending == PoseEnding::kDeadline ? SPHC_OUTCOME_DEADLINE : SPHC_OUTCOME_NO_CONSENSUS;
}

// By a clock that may step back.
uint64_t elapsedNs(int64_t begin_ns, int64_t end_ns) {
  return end_ns > begin_ns ? static_cast<uint64_t>(end_ns) - static_cast<uint64_t>(begin_ns) : 0;
}

uint32_t microseconds(uint64_t ns) { return static_cast<uint32_t>(std::min<uint64_t>(ns / 1000, UINT32_MAX)); }

double capFor(const Prediction &expected) {
  const double sigma_rad = expected.rotation_sigma_rad + expected.translation_sigma_m / kTypicalDepth_m;
  return std::max(kLeastCap, kCapSigmas * sigma_rad);
}

// What is left is moved to the front.
Span<const Correspondence> withoutLevers(const Levers &levers, Span<Correspondence> correspondences) {
  const auto begin = levers.indices.begin(), end = levers.indices.end();
  uint32_t left = 0;
  for (uint32_t i = 0; i < correspondences.size(); ++i)
    if (std::find(begin, end, i) == end) correspondences[left++] = correspondences[i];
  return correspondences.first(left);
}

// Does the caller's pose say where to look?
bool isNarrow(const Known &known) {
  return known.prior.has_pose && capFor({known.map, known.prior.camera_from_map, known.prior.rotation_sigma_rad,
                                         known.prior.translation_sigma_m}) < kMostCap;
}

}  // namespace

void Localizer::layout(const sphc_config &config, Arena &state, Arena &scratch, Localizer *localizer) {
  const uint32_t n = config.max_keypoints;
  EstimatorConfig estimator;
  estimator.capacity = 2 * n;  // this frame's and those of the history
  estimator.max_iterations = config.max_iterations;

  Localizer discarded;  // receives empty spans while measuring
  Localizer &l = localizer ? *localizer : discarded;
  FrontEnd::layout(config, state, scratch, localizer ? &l.front_ : nullptr);
  History::layout(n, state, localizer ? &l.history_ : nullptr);
  l.expected_ = scratch.take<Direction>("localizer.expected", n);
  l.matches_ = scratch.take<Match>("localizer.matches", n);
  l.kept_matches_ = scratch.take<Match>("localizer.matches", n);
  l.ray_matches_ = scratch.take<Match>("localizer.matches", n);
  l.correspondences_ = scratch.take<Correspondence>("localizer.correspondences", estimator.capacity);
  Matcher::layout(n, scratch, localizer ? &l.matcher_ : nullptr);
  PoseEstimator::layout(estimator, scratch, localizer ? &l.estimator_ : nullptr);
}

void Localizer::init(const sphc_config &config) {
  config_ = config;
  front_.init(config);
  DepthCalibration prior;
  prior.mid_m = config.depth_mid_m > 0 ? config.depth_mid_m : sqrtOf(config.depth_min_m * config.depth_max_m);
  prior.covariance(0, 0) = config.depth_offset_sigma_m * config.depth_offset_sigma_m;
  prior.covariance(1, 1) = config.depth_slope_sigma * config.depth_slope_sigma;
  calibrator_.init(prior);
}

void Localizer::reset() {
  tracker_.reset();
  history_.clear();
}

void Localizer::process(const sphc_frame &frame, sphc_result *result) {
  const int64_t begin = now();
  recordDepth(result);
  front_.extract(frame.color);
  const int64_t extracted = now();
  const Known known = knownFromDoor(isPaper() ? nullptr : frame.prior);
  if (tracks()) advance(frame, known);
  front_.lift(frame.depth, colorFromDepth(frame));
  const int64_t aligned = now();

  kept_ = {};
  samples_ = 0;
  match_ns_ = 0;
  match_count_ = ray_match_count_ = 0;
  if (front_.keypointCount() < kFewestKeypoints) {
    kept_.look.outcome = SPHC_OUTCOME_FEW_KEYPOINTS;
  } else if (front_.liftedCount() < kFewestLifted) {
    kept_.look.outcome = SPHC_OUTCOME_FEW_DEPTHS;
  } else {
    Deadline deadline;
    if (config_.deadline_us)
      deadline = Deadline::after(config_.clock, config_.clock_user, begin, int64_t{config_.deadline_us} * 1000);
    locate(known, deadline);
  }
  conclude(result);
  const uint64_t located_ns = elapsedNs(aligned, now());
  result->features_us = microseconds(elapsedNs(begin, extracted));
  result->align_us = microseconds(elapsedNs(extracted, aligned));
  result->match_us = microseconds(match_ns_);
  result->pose_us = microseconds(located_ns > match_ns_ ? located_ns - match_ns_ : 0);
  log(*result);
}

void Localizer::advance(const sphc_frame &frame, const Known &known) {
  tracker_.advance(frame.color_time_ns, known.has_odometry ? &known.odometry : nullptr);
  Rigid step;
  double rotation_sigma_rad = 0, translation_sigma_m = 0;
  if (tracker_.step(&step, &rotation_sigma_rad, &translation_sigma_m))
    history_.advance(step, rotation_sigma_rad, translation_sigma_m);
  else
    history_.clear();
}

// The camera moves between the two exposures; odometry tells how.
Rigid Localizer::colorFromDepth(const sphc_frame &frame) const {
  const Rigid color_from_depth = rigidFromDoor(config_.color_from_depth);
  Rigid moved;
  if (!tracks() || frame.depth_time_ns == frame.color_time_ns) return color_from_depth;
  return tracker_.motionSince(frame.depth_time_ns, &moved) ? moved * color_from_depth : color_from_depth;
}

void Localizer::locate(const Known &known, const Deadline &deadline) {
  Prediction expected;
  if (expect(known, &expected)) consider(lookNear(known, deadline, expected));
  if (!isDone(deadline)) lookEverywhere(known, deadline);
  if (kept_.look.outcome == SPHC_OUTCOME_LOCALIZED || !deadline.passed()) return;
  kept_.look.outcome = SPHC_OUTCOME_DEADLINE;
  kept_.look.searched.cut_short = true;
}

// Where no look localizes, the last global one into the likeliest map stands for the frame.
void Localizer::consider(const Look &look) {
  const bool localized = look.outcome == SPHC_OUTCOME_LOCALIZED;
  if (kept_.any && !kept_.look.guided && !localized && look.map != kept_.look.map) return;
  kept_ = {true, look, match_count_};
  std::copy_n(matches_.data(), match_count_, kept_matches_.data());
}

bool Localizer::isDone(const Deadline &deadline) const {
  return kept_.look.outcome == SPHC_OUTCOME_LOCALIZED || deadline.passed();
}

// From the caller, else from the frames before; false where both say too little to narrow the search.
bool Localizer::expect(const Known &known, Prediction *expected) const {
  if (isNarrow(known)) {
    *expected = {known.map, known.prior.camera_from_map, known.prior.rotation_sigma_rad,
                 known.prior.translation_sigma_m};
    return true;
  }
  return tracks() && tracker_.predict(expected) && capFor(*expected) < kMostCap;
}

Localizer::Look Localizer::lookNear(const Known &known, const Deadline &deadline, const Prediction &expected) {
  Look look;
  look.map = expected.map;
  look.guided = true;
  const double cap_rad = capFor(expected);
  PosePrior prior = priorFor(known, expected.map);
  prior.has_pose = true;
  prior.camera_from_map = expected.camera_from_map;
  prior.rotation_sigma_rad = expected.rotation_sigma_rad;
  prior.translation_sigma_m = expected.translation_sigma_m;
  PoseQuery query = queryFor(prior, deadline);
  ray_match_count_ = 0;
  askAbout(look.map, front_.liftedCount(), 1);  // guided matching has probes of its own
  query.correspondences = correspond(look.map, matchAround(expected.camera_from_map, cap_rad));
  findPose(query, solidAngle(cap_rad), {kCapsOfExpectedPose, 1}, &look);
  return look;
}

void Localizer::lookEverywhere(const Known &known, const Deadline &deadline) {
  const MapOrder order = rankMaps();
  const uint32_t remembered = mapToRemember(order);
  for (uint32_t map : order) {
    PosePrior prior = priorFor(known, map);
    if (isNarrow(known)) prior.has_pose = false;  // a look there has failed
    lookInto(map, queryFor(prior, deadline), map == remembered);
    if (isDone(deadline)) break;
  }
}

void Localizer::lookInto(uint32_t map, PoseQuery query, bool remembers) {
  Look look, whole;
  look.map = whole.map = map;
  const uint32_t lifted = front_.liftedCount();
  // The paper's cost knows no keypoints without depth.
  const uint32_t all = isPaper() ? lifted : front_.keypointCount();
  askAbout(map, all, config_.probes);
  if (!isPaper() && config_.probes > 0 && lifted > kStrongest) {
    query.correspondences = matchEverywhere(map, kStrongest);
    findPose(query, 4 * kPi, {kCapsOfFirstPose, 2}, &look);  // in its second look all take part
    const bool beyond_doubt = look.evidence.log_chance_first < kBeyondDoubt;
    if ((look.outcome == SPHC_OUTCOME_LOCALIZED && beyond_doubt) || query.deadline.passed()) return consider(look);
  }
  query.correspondences = matchEverywhere(map, all);
  const bool has_history = remembers && remember(map);
  findPose(query, 4 * kPi, {kCapsOfFirstPose, 2}, &whole);
  consider(whole);
  if (has_history && !isDone(query.deadline)) consider(lookTogether(map, query));
}

// The global matches of this frame and of those before it, as odometry moves them.
Localizer::Look Localizer::lookTogether(uint32_t map, PoseQuery query) {
  Look look;
  look.map = map;
  look.frames = history_.frames();
  match_count_ = 0;  // they are in the history too
  query.correspondences = withHistory(map);
  findPose(query, 4 * kPi, {kCapsOfFirstPose, 2}, &look);
  return look;
}

// `solid_angle_sr`: in which map points were candidates.
void Localizer::findPose(const PoseQuery &query, double solid_angle_sr, Caps caps_rad, Look *look) {
  if (query.correspondences.size() < kFewestMatches) return;
  const Estimate &found = look->searched = look->estimate = firstPose(query);
  look->outcome = outcomeOf(found.ending);
  if (found.inliers <= kFewestMatches / 2) return;
  look->evidence.looks = look->guided ? Looks::kGuided : Looks::kGlobal;
  look->evidence.log_chance_first =
      logChanceOfAgreement(query.correspondences, found.camera_from_map, found.inliers, 3, query.depth.noise_scale,
                           estimator_.inlierThreshold2(), solid_angle_sr) +
      logOf(static_cast<double>(found.iterations) + 1);
  improve(query, caps_rad, look);
  contest(query, caps_rad, look);
  contestMirrored(query, caps_rad, look);
}

// A pose says where in the map each keypoint lies: look there again.  True points that lost the ratio test against
// some distant twin come back, and fakes, which lie anywhere, drop out.
void Localizer::improve(PoseQuery query, Caps caps_rad, Look *look) {
  double last_cap_rad = 0;
  for (double cap_rad : caps_rad) {
    query.correspondences = correspond(look->map, matchAround(look->estimate.camera_from_map, cap_rad));
    if (look->frames > 1) query.correspondences = withHistory(look->map);
    look->estimate = refined(query, look->estimate.camera_from_map);
    last_cap_rad = cap_rad;
  }
  uint32_t seen_now = 0;
  for (const Correspondence &c : correspondences_.first(match_count_))
    if (estimator_.isInlier(c, look->estimate)) ++seen_now;
  look->evidence.inliers = look->estimate.inliers;
  look->evidence.log_chance_second =
      logChanceOfAgreement(correspondences_.first(match_count_), look->estimate.camera_from_map, seen_now, 3,
                           query.depth.noise_scale, estimator_.inlierThreshold2(), solidAngle(last_cap_rad));
  findLevers(look);
  look->evidence.vaguer = look->levers.vaguer;
  look->outcome = judgePose(look->evidence, look->estimate, config_.min_inliers);
}

// Among many matches a few that are wrong have no say.
void Localizer::findLevers(Look *look) const {
  look->levers = {};
  const uint32_t inliers = look->estimate.inliers;
  if (inliers >= kInliersBeyondContest || isPaper()) return;
  const Span<const Correspondence> used = {correspondences_.data(), used_count_};
  look->levers = heaviestLevers(used, look->estimate, 1 + inliers / kInliersALever);
}

// A pose may rest on one or two wrong matches, far from the others, that turn it by degrees: what would be found
// without them has a second look too, and the better of the two stays.
void Localizer::contest(const PoseQuery &query, Caps caps_rad, Look *look) {
  if (look->levers.vaguer < kRestsOnFew) return;
  PoseQuery without = query;
  without.correspondences = withoutLevers(look->levers, correspondences_.first(used_count_));
  Look rival = *look;
  rival.estimate = estimator_.search(without);
  samples_ += rival.estimate.iterations;
  if (rival.estimate.inliers > kFewestMatches / 2) {
    improve(query, caps_rad, &rival);
    if (rival.estimate.gain > look->estimate.gain) {
      *look = rival;
      return;
    }
  }
  improve(query, caps_rad, look);  // which brings back the matches that speak for it
}

// A flat scene far from the centre has a second pose, which the few matches of a first look may prefer.  Both are
// asked of all that the second look brought; where they are nearly alike, nobody can tell.
void Localizer::contestMirrored(PoseQuery query, Caps caps_rad, Look *look) {
  if (look->outcome != SPHC_OUTCOME_LOCALIZED || look->guided || isPaper()) return;
  query.correspondences = {correspondences_.data(), used_count_};
  Look rival = *look;
  rival.estimate = estimator_.refineMirrored(query, look->estimate.camera_from_map);
  const Rigid apart = rival.estimate.camera_from_map * look->estimate.camera_from_map.inverse();
  if (rival.estimate.gain < kNearlyAsGood * look->estimate.gain || rotationAngle(apart.rotation) < kSamePoseRad)
    return;
  improve(query, caps_rad, &rival);
  const double gain = look->estimate.gain;
  if (rival.estimate.gain > gain)
    *look = rival;
  else
    improve(query, caps_rad, look);  // which brings its matches back
  if (std::min(gain, rival.estimate.gain) > kNearlyAsGood * std::max(gain, rival.estimate.gain))
    look->outcome = SPHC_OUTCOME_UNCERTAIN;
}

// Which maps to look into, the likeliest first.
Localizer::MapOrder Localizer::rankMaps() {
  MapOrder order;
  uint32_t votes[SPHC_MAPS_MAX] = {}, most = 0;
  for (uint32_t map = 0; map < mapCount() && mapCount() > 1; ++map) {
    askAbout(map, std::min(kVoters, front_.liftedCount()), kVoteProbes);
    votes[map] = static_cast<uint32_t>(matchEverywhere(map, std::min(kVoters, front_.liftedCount())).size());
    most = std::max(most, votes[map]);
  }
  for (uint32_t rank = 0; rank < kMapsTried && rank < mapCount(); ++rank) {
    uint32_t best = mapCount();
    for (uint32_t map = 0; map < mapCount(); ++map) {
      const bool taken = std::find(order.begin(), order.end(), map) != order.end();
      if (!taken && (best == mapCount() || votes[map] > votes[best])) best = map;
    }
    if (rank > 0 && 2 * votes[best] < most) break;
    order.push(best);
  }
  return order;
}

// Frames are put together for one map at a time: as long as it is likely, the one that earlier frames spoke for.
uint32_t Localizer::mapToRemember(const MapOrder &order) const {
  const bool likely = std::find(order.begin(), order.end(), history_map_) != order.end();
  return likely && history_.frames() > 0 ? history_map_ : order[0];
}

// Keeps the global matches of this frame for later ones; true when there are some of earlier frames too.
bool Localizer::remember(uint32_t map) {
  if (!tracks() || !tracker_.hasOdometry()) return false;
  if (map != history_map_) history_.clear();
  history_map_ = map;
  for (uint32_t i = 0; i < match_count_; ++i)
    if (correspondences_[i].lifted.hasDepth())
      history_.add(correspondences_[i].lifted, matches_[i].map_index, correspondences_[i].quality);
  return history_.frames() > 1;
}

PosePrior Localizer::priorFor(const Known &known, uint32_t map) const {
  return known.map == map ? known.prior : PosePrior();
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

PaperCostConfig Localizer::paperConfig() const {
  PaperCostConfig paper;
  paper.focal_px = 0.5 * (config_.color_camera.params[0] + config_.color_camera.params[1]);
  paper.max_iterations = config_.max_iterations;
  return paper;
}

Estimate Localizer::firstPose(const PoseQuery &query) {
  const Estimate found = isPaper() ? estimateWithPaperCost(paperConfig(), query.correspondences, query.seed)
                                   : estimator_.search(query);
  samples_ += found.iterations;
  if (!isPaper() || found.inliers == 0) return found;
  Estimate estimate = estimator_.evaluate(query, found.camera_from_map);
  estimate.iterations = found.iterations;
  return estimate;
}

Estimate Localizer::refined(const PoseQuery &query, const Rigid &camera_from_map) {
  if (!isPaper()) return estimator_.refine(query, camera_from_map);
  const Rigid pose = refineWithPaperCost(paperConfig(), query.correspondences, camera_from_map, kPaperIterations);
  return estimator_.evaluate(query, pose);
}

// The matches that follow are those of the first `keypoints` with this map.
void Localizer::askAbout(uint32_t map, uint32_t keypoints, uint32_t probes) {
  const int64_t begin = now();
  matcher_.ask(maps_[map], front_.descriptors().first(keypoints), probes);
  match_ns_ += elapsedNs(begin, now());
}

Span<const Correspondence> Localizer::matchEverywhere(uint32_t map, uint32_t keypoints) {
  const int64_t begin = now();
  const uint32_t count = config_.probes ? matcher_.matchAll(keypoints, config_.max_ratio, matches_)
                                        : matcher_.matchExact(config_.max_ratio, matches_);
  match_ns_ += elapsedNs(begin, now());
  correspond(map, count);
  keepRays();
  return correspondences_.first(count);
}

// Matches each lifted keypoint near where the pose says it lies.
uint32_t Localizer::matchAround(const Rigid &camera_from_map, double cap_rad) {
  const int64_t begin = now();
  const uint32_t lifted = front_.liftedCount();
  const Rigid map_from_camera = camera_from_map.inverse();
  for (uint32_t i = 0; i < lifted; ++i) {
    const Vector3 d = (map_from_camera * front_.lifted()[i].point_m).normalized();
    expected_[i] = {static_cast<float>(d.x()), static_cast<float>(d.y()), static_cast<float>(d.z())};
  }
  double sine, cosine;
  sinCos(cap_rad, &sine, &cosine);
  uint32_t count =
      matcher_.matchNear(expected_.first(lifted), static_cast<float>(cosine), config_.max_ratio, matches_);
  for (uint32_t i = 0; i < ray_match_count_; ++i) matches_[count++] = ray_matches_[i];
  match_ns_ += elapsedNs(begin, now());
  return count;
}

// Matches of keypoints without depth are those of the first look: without depth a pose does not say where to look.
void Localizer::keepRays() {
  ray_match_count_ = 0;
  for (uint32_t i = 0; i < match_count_; ++i)
    if (matches_[i].query >= front_.liftedCount()) ray_matches_[ray_match_count_++] = matches_[i];
}

Span<const Correspondence> Localizer::correspond(uint32_t map, uint32_t match_count) {
  match_count_ = match_count;
  for (uint32_t i = 0; i < match_count; ++i) {
    correspondences_[i] = correspondenceOf(map, matches_[i]);
  }
  used_count_ = match_count;
  return correspondences_.first(match_count);
}

Correspondence Localizer::correspondenceOf(uint32_t map, const Match &match) const {
  return {front_.lifted()[match.query], directionOf(map, match.map_index),
          1.0f - static_cast<float>(match.distance2) / static_cast<float>(match.second2 + 1)};
}

// Behind the correspondences of this frame those of the history, each map point once: the same wrong match, seen
// twice, is no evidence.
Span<const Correspondence> Localizer::withHistory(uint32_t map) {
  uint32_t count = match_count_;
  for (const OldMatch &old : history_.matches()) {
    if (match_count_ > 0 && old.age == 0) continue;
    bool seen = false;
    for (uint32_t i = 0; i < match_count_ && !seen; ++i) seen = matches_[i].map_index == old.map_index;
    if (!seen) correspondences_[count++] = {old.lifted, directionOf(map, old.map_index), old.quality};
  }
  used_count_ = count;
  return correspondences_.first(count);
}

Vector3 Localizer::directionOf(uint32_t map, uint32_t point) const {
  const Direction d = maps_[map].direction(point);
  return Vector3(static_cast<double>(d.x), static_cast<double>(d.y), static_cast<double>(d.z));
}

void Localizer::conclude(sphc_result *result) {
  const Look &look = kept_.look;
  const bool localized = look.outcome == SPHC_OUTCOME_LOCALIZED;
  result->outcome = look.outcome;
  result->keypoints = front_.keypointCount();
  result->lifted = front_.liftedCount();
  result->matches = kept_.matches;
  result->inliers = look.estimate.inliers;
  result->iterations = samples_;
  result->cut_short = look.searched.cut_short;
  result->map_index = look.map;
  result->frames = look.frames;
  result->guided = look.guided;
  for (const Match &match : kept_matches_.first(kept_.matches)) {
    sphc_observation &observation = front_.observationOf(match.query);
    observation.map_index = match.map_index;
    observation.flags |= SPHC_OBSERVATION_MATCHED;
    if (localized && estimator_.isInlier(correspondenceOf(look.map, match), look.estimate))
      observation.flags |= SPHC_OBSERVATION_INLIER;
  }
  if (localized) {
    fillPose(look.estimate, result);
    result->confidence = confidenceOf(confidenceInputs(look.searched, look.estimate));
    if (!isPaper()) calibrator_.learn(look.estimate);
    history_.clear();
  }
  if (!tracks()) return;
  if (localized)
    tracker_.accept(look.map, look.estimate);
  else
    tracker_.miss();
  result->state = tracker_.state();
}

void Localizer::fillPose(const Estimate &estimate, sphc_result *result) const {
  result->camera_from_map = doorFromRigid(estimate.camera_from_map);
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 6; ++column)
      result->covariance[6 * row + column] = estimate.covariance(row, column);
}

void Localizer::recordDepth(sphc_result *result) const {
  const DepthCalibration &depth = calibrator_.current();
  result->depth = {depth.mid_m,
                   depth.mean[0],
                   depth.mean[1],
                   sqrtOf(depth.covariance(0, 0)),
                   sqrtOf(depth.covariance(1, 1)),
                   depth.noise_scale};
}

void Localizer::log(const sphc_result &result) const {
  if (!config_.log) return;
  sphc_message text;
  MessageWriter(&text) << "frame " << result.sequence << ": "
                       << (result.outcome == SPHC_OUTCOME_LOCALIZED ? "localized" : "not localized") << ", outcome "
                       << result.outcome << ", keypoints " << result.keypoints << ", lifted " << result.lifted
                       << ", matches " << result.matches << ", inliers " << result.inliers << ", state "
                       << result.state << ", map " << result.map_index;
  size_t length = 0;
  while (text.text[length]) ++length;
  config_.log(config_.log_user, SPHC_LOG_DEBUG, text.text, length);
}

}  // namespace sphc
