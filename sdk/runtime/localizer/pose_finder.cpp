#include "runtime/localizer/pose_finder.h"

#include <algorithm>
#include <utility>

#include "runtime/localizer/hints.h"
#include "runtime/localizer/tuning.h"

namespace sphc {

using namespace tuning;

namespace {

// A caller knows of a pose what it says, and a track as much as makes no jump.
bool isWhereExpected(const Rigid &found, const Prediction &expected, bool by_caller) {
  return areNear(found, expected.camera_from_map,
                 boundsOfNoJump(expected.rotation_sigma_rad, expected.translation_sigma_m,
                                by_caller ? kNoJump : kNoJumpOfTrack));
}

PosePrior priorFor(const Known &known, uint32_t map) { return known.map == map ? known.prior : PosePrior(); }

// Where nothing localizes, the last global search of the likeliest map stands for the frame.
bool replaces(const Hypothesis &candidate, const Hypothesis &best) {
  return candidate.isLocalized() || !best.tried || best.guided || candidate.map == best.map;
}

// Where not all keypoints were asked: few inliers that chance nearly explains were wrong.
bool isClear(const Hypothesis &found, uint32_t min_inliers) {
  return found.estimate.inliers >= kTimesInliersUnasked * min_inliers &&
         found.evidence.log_chance_first < kMostLogChance;
}

}  // namespace

void PoseFinder::layout(const LocalizerConfig &config, Arena &state, Arena &scratch, PoseFinder *finder) {
  const uint32_t n = config.max_keypoints;
  EstimatorConfig estimator;
  estimator.capacity = 2 * n;  // this frame's correspondences and those of earlier ones
  estimator.max_iterations = config.search.max_iterations;
  estimator.has_centres = config.further.size() > 0;
  Search::layout(config, state, scratch, finder ? &finder->search_ : nullptr);
  MatchSet::layout(n, scratch, finder ? &finder->best_.matched : nullptr);
  MatchSet::layout(n, scratch, finder ? &finder->candidate_.matched : nullptr);
  MatchSet::layout(n, scratch, finder ? &finder->rival_.matched : nullptr);
  Repetition::layout(n, config.parallel, scratch, finder ? &finder->repetition_ : nullptr);
  PoseEstimator::layout(estimator, scratch, finder ? &finder->estimator_ : nullptr);
}

void PoseFinder::init(const LocalizerConfig &config) {
  parameters_ = config.search;
  seed_ = config.seed;
  search_.init(config);
  repetition_.setParallel(config.parallel);
}

void PoseFinder::setParameters(const SearchParameters &parameters) {
  parameters_ = parameters;
  search_.setParameters(parameters);
  estimator_.setMaxIterations(parameters.max_iterations);
}

void PoseFinder::begin(const Frame &frame) {
  frame_ = frame;
  best_.challenge({});
  ranking_.clear();
  was_asked_ = false;
  clear_ = 0;
}

void PoseFinder::find(const Known &known, const Deadline &deadline, Work *work) {
  best_.challenge({});
  ranking_.clear();
  const bool few = frame_.front->keypointCount() < kFewestKeypoints;
  if (few || frame_.front->liftedCount() < kFewestLifted) {
    best_.outcome = frame_.front->wasCut() ? Outcome::kDeadline
                    : few                  ? Outcome::kFewKeypoints
                                           : Outcome::kFewDepths;
    return;
  }
  Prediction expected;
  if (expects(known, frame_.front->wasCut() ? kMostConeInHasteRad : kMostConeRad, &expected))
    searchNear(known, expected, deadline, work);
  if (!isDone(deadline, work)) searchEverywhere(known, deadline, work);
  if (!best_.isLocalized() && work->cuts) best_.outcome = Outcome::kDeadline;
}

const Hypothesis &PoseFinder::findMirrored(const Deadline &deadline, Work *work) {
  Ranking of_mirrored;  // poses that the frame itself does not have
  frame_.front->mirror();
  const PosePrior nothing;
  const uint32_t all = frame_.front->keypointCount();
  const PoseTask task = {search_.ask(*frame_.front, best_.map, all, parameters_.probes, work),
                         {},
                         queryFor(nothing, deadline),
                         4 * kPi,
                         {kConesOfSearchedPose, 2}};
  candidate_.begin(best_.map);
  search_.matchEverywhere(task.question, all, deadline.afterShare(kMatchShare), &candidate_.matched, work);
  verification(parameters_.min_inliers, work, &of_mirrored).findUnverifiedPose(task, &candidate_);
  frame_.front->mirror();
  return candidate_;
}

void PoseFinder::confirm(const Deadline &deadline, Work *work) {
  const Cuts before = std::exchange(work->cuts, Cuts{0});
  const PosePrior nothing;
  PoseTask task = taskOfWholeMap(best_.map, queryFor(nothing, deadline), work);
  task.expected = &best_.estimate.camera_from_map;
  matchAll(best_.map, &task, work);
  solve(task, work);
  const bool is_found =
      candidate_.isLocalized() && areNear(candidate_.estimate.camera_from_map, *task.expected, kNoJump);
  const bool was_cut = work->cuts != 0 || deadline.passed();
  work->cuts |= was_cut ? before | kCutVerification : before;
  if (!is_found && !was_cut) return best_.doubtForRival();
  best_.has_near_rival = best_.has_near_rival || was_cut || candidate_.has_near_rival;
}

bool PoseFinder::expects(const Known &known, double most_cone_rad, Prediction *expected) const {
  return expectedPose(known, frame_.tracker, most_cone_rad, expected);
}

void PoseFinder::searchNear(const Known &known, const Prediction &expected, const Deadline &deadline, Work *work) {
  PosePrior prior = priorFor(known, expected.map);
  prior.has_pose = true;
  prior.camera_from_map = expected.camera_from_map;
  prior.rotation_sigma_rad = expected.rotation_sigma_rad;
  prior.translation_sigma_m = expected.translation_sigma_m;
  candidate_.begin(expected.map);
  candidate_.guided = true;
  const double cone_rad = coneOf(expected);
  // matching near a direction has probes of its own
  const Search::Question question = search_.ask(*frame_.front, expected.map, frame_.front->liftedCount(), 1, work);
  const Deadline own = deadline.afterShare(kNearShare);
  search_.matchNear(question, expected.camera_from_map, cone_rad, {}, own.afterShare(kMatchShare),
                    &candidate_.matched, work);
  solve({question, {}, queryFor(prior, own), solidAngleOf(cone_rad), {kConesOfExpectedPose, 1}}, work);
  // A pose elsewhere lacks what a search of the whole map would hold against it.
  if (candidate_.isLocalized() && !isWhereExpected(candidate_.estimate.camera_from_map, expected, isNarrow(known)))
    candidate_.outcome = Outcome::kUncertain;
  propose();
}

void PoseFinder::searchEverywhere(const Known &known, const Deadline &deadline, Work *work) {
  const MapOrder order = search_.rankMaps(*frame_.front, deadline.afterShare(kMatchShare), work);
  if (order.size() == 0) return;  // there is no map
  const bool fuses = frame_.tracker && frame_.tracker->knowsShifts();
  const uint32_t remembered = frame_.fusion->mapToRemember(order);
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
void PoseFinder::searchMap(uint32_t map, bool remembers, const PoseQuery &query, Work *work) {
  Prediction expected;
  PoseTask task = taskOfWholeMap(map, query, work);
  if (frame_.tracker && frame_.tracker->predict(&expected) && expected.map == map)
    task.expected = &expected.camera_from_map;
  const bool has_many = frame_.front->liftedCount() > kStrongest;
  if (parameters_.probes > 0 && has_many && searchMapByStrongest(map, task, work)) return propose();
  matchAll(map, &task, work);
  was_asked_ = work->cuts == 0;
  clear_ = std::max(clear_, countClear(candidate_.matched.matches()));
  const bool has_others = remembers && !frame_.images_are_apart && frame_.fusion->remember(map, candidate_.matched);
  solve(task, work);
  bool has_pose = candidate_.hasPose();
  propose();
  if (isDone(query.deadline, work)) return;
  if (has_others) {
    candidate_.begin(map, frame_.fusion->frames());
    frame_.fusion->addTo(*task.question.map, &candidate_.matched);
    solve(task, work);
    has_pose = has_pose || candidate_.hasPose();
    propose();
  }
  if (!has_pose && !isDone(query.deadline, work)) searchMapLoosely(map, task, work);
}

PoseTask PoseFinder::taskOfWholeMap(uint32_t map, const PoseQuery &query, Work *work) {
  const FrontEnd &front = *frame_.front;
  const uint32_t strongest = std::min(front.liftedCount(), kStrongest);
  const uint32_t probes = search_.probesWithin(strongest, query.deadline.afterShare(kMatchShare), work);
  return {
      search_.ask(front, map, front.keypointCount(), probes, work), {}, query, 4 * kPi, {kConesOfSearchedPose, 2}};
}

// Makes the candidate's matches those of all keypoints.
void PoseFinder::matchAll(uint32_t map, PoseTask *task, Work *work) {
  candidate_.begin(map);
  search_.matchEverywhere(task->question, frame_.front->keypointCount(),
                          task->query.deadline.afterShare(kMatchShare), &candidate_.matched, work);
  task->rays = search_.raysOf(*frame_.front, candidate_.matched);
}

// True where that ends the search.  In guided re-matching all keypoints take part.
bool PoseFinder::searchMapByStrongest(uint32_t map, const PoseTask &task, Work *work) {
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
  if (!isClear(candidate_, parameters_.min_inliers)) candidate_.outcome = Outcome::kUncertain;
  return true;
}

// What does not localize leaves the frame as the strict test shows it.
void PoseFinder::searchMapLoosely(uint32_t map, const PoseTask &task, Work *work) {
  candidate_.begin(map);
  verification(kTimesInliersOfLooser * parameters_.min_inliers, work, &ranking_)
      .findPoseLoosely(task, &candidate_, &rival_);
  if (candidate_.isLocalized()) propose();
}

// Finds the pose that the candidate's matches speak for.
void PoseFinder::solve(const PoseTask &task, Work *work) {
  verification(parameters_.min_inliers, work, &ranking_).findPose(task, &candidate_, &rival_);
}

Verification PoseFinder::verification(uint32_t min_inliers, Work *work, Ranking *ranking) {
  return Verification(&search_, &estimator_, &repetition_, frame_.fusion, min_inliers, frame_.tracker != nullptr,
                      work, ranking);
}

void PoseFinder::propose() {
  if (replaces(candidate_, best_)) swap(candidate_, best_);
}

// `prior` is borrowed.
PoseQuery PoseFinder::queryFor(const PosePrior &prior, const Deadline &deadline) const {
  PoseQuery query;
  query.prior = &prior;
  query.depth = frame_.depth;
  query.seed = seed_;
  query.deadline = deadline;
  return query;
}

// Is the frame localized, or no time left for another search?
bool PoseFinder::isDone(const Deadline &deadline, Work *work) const {
  if (best_.isLocalized()) return true;
  if (!deadline.passed()) return false;
  work->cuts |= kCutSearch;
  return true;
}

}  // namespace sphc
