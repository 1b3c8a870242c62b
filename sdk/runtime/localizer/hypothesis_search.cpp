#include "runtime/localizer/hypothesis_search.h"

#include <algorithm>

#include "runtime/localizer/tuning.h"

namespace sphc {

using namespace tuning;

namespace {

static_assert(1 + kInliersBeyondChallenge / kInliersALeverage <= kMostHighLeverage, "so many may be left out");

// Until a pose that was found is judged.
Outcome outcomeOf(PoseEnding ending) {
  if (ending == PoseEnding::kFewCorrespondences) return Outcome::kFewMatches;
  return ending == PoseEnding::kDeadline ? Outcome::kDeadline : Outcome::kNoConsensus;
}

}  // namespace

PoseQuery queryAbout(const PoseTask &task, const MatchSet &matched) {
  PoseQuery query = task.query;
  query.correspondences = matched.all();
  return query;
}

bool HypothesisSearch::isCut(const PoseTask &task) const {
  if (!task.query.deadline.passed()) return false;
  work_.cuts |= kCutVerification;
  return true;
}

bool HypothesisSearch::isLeftOut(const PoseTask &task, Hypothesis *found) const {
  if (!isCut(task)) return false;
  found->is_verified = false;
  return true;
}

bool HypothesisSearch::search(const PoseTask &task, Hypothesis *hypothesis) const {
  PoseQuery query = queryAbout(task, hypothesis->matched);
  if (query.correspondences.size() < kFewestMatches) return false;
  query.deadline = task.query.deadline.afterShare(kSearchShare);
  const Estimate &found = hypothesis->searched = hypothesis->estimate = estimator_.search(query);
  work_.samples += found.iterations;
  if (found.cut_short) work_.cuts |= kCutSearch;
  hypothesis->outcome = outcomeOf(found.ending);
  if (found.inliers <= kFewestMatches / 2) return false;
  hypothesis->evidence.source = hypothesis->guided ? MatchSource::kExpected : MatchSource::kGlobal;
  hypothesis->evidence.log_chance_first =
      logChanceOfAgreement(query.correspondences, found.camera_from_map, found.inliers,
                           {query.depth.noise_scale, estimator_.inlierThreshold2(), task.solid_angle_sr}) +
      logOf(static_cast<double>(found.iterations) + 1);
  return true;
}

bool HypothesisSearch::searchOtherMatches(const PoseTask &task, const PosePrior *prior, float max_ratio,
                                          Hypothesis *hypothesis, PoseTask *other) const {
  const FrontEnd &front = *task.question.front;
  *other = task;
  other->max_ratio = max_ratio;
  other->query.prior = prior;
  other->query.seed += kOtherSeed;
  search_.matchEverywhere(task.question, answerable(task), max_ratio, task.query.deadline, &hypothesis->matched,
                          &work_);
  other->rays = search_.raysOf(front, hypothesis->matched, task.rays);
  if (hypothesis->frames > 1) fusion_.addTo(*task.question.map, &hypothesis->matched);
  return search(*other, hypothesis);
}

uint32_t HypothesisSearch::answerable(const PoseTask &task) const {
  const uint32_t all = task.question.front->keypointCount();
  const uint32_t keypoints = search_.answerable(all, task.query.deadline.afterShare(kMatchShare));
  if (keypoints < all) work_.cuts |= kCutMatches;
  return keypoints;
}

void HypothesisSearch::rematch(const PoseTask &task, Hypothesis *hypothesis) const {
  matchInCones(task, hypothesis);
  judge(task, hypothesis);
  ranking_.add(*hypothesis, search_.maps().idOf(hypothesis->map));
}

// A pose says where in the map each keypoint lies: match them again near there.  True points that lost the ratio
// test against some distant near-duplicate come back, and fakes, which lie anywhere, drop out.
void HypothesisSearch::matchInCones(const PoseTask &task, Hypothesis *hypothesis) const {
  Estimate &estimate = hypothesis->estimate;
  MatchSet &matched = hypothesis->matched;
  const Deadline own = task.query.deadline.afterShare(hypothesis->guided ? kRematchNearShare : kRematchShare);
  const auto cones = static_cast<uint32_t>(task.cones_rad.size());
  // The narrow cone alone where there is no time for all.
  const bool has_time = search_.hasTimeNear(cones * task.question.front->liftedCount(), own);
  if (!has_time) work_.cuts |= kCutVerification;
  for (uint32_t cone = has_time ? 0 : cones - 1; cone < cones; ++cone) {
    if (isLeftOut(task, hypothesis)) return;
    const bool is_last = cone + 1 == cones;
    search_.matchNear(task.question, estimate.camera_from_map, task.cones_rad[cone], task.rays,
                      is_last ? own : own.afterShare(kFirstConeShare), &matched, &work_);
    if (hypothesis->frames > 1) fusion_.addTo(*task.question.map, &matched);
    estimate = estimator_.refine(queryAbout(task, matched), estimate.camera_from_map);
  }
}

// By the matches that guided re-matching brought.
void HypothesisSearch::judge(const PoseTask &task, Hypothesis *hypothesis) const {
  Estimate &estimate = hypothesis->estimate;
  const Span<const Correspondence> now = hypothesis->matched.ofThisFrame();
  const auto agrees = [&](const Correspondence &c) { return estimator_.isInlier(c, estimate); };
  const auto inliers = static_cast<uint32_t>(std::count_if(now.begin(), now.end(), agrees));
  if (hypothesis->frames > 1 && estimate.inliers > inliers)
    fusion_.widenByDrift(1 - static_cast<double>(inliers) / estimate.inliers, &estimate);
  const double last_cone_rad = task.cones_rad[task.cones_rad.size() - 1];
  Evidence &evidence = hypothesis->evidence;
  evidence.inliers = estimate.inliers;
  evidence.log_chance_second = logChanceOfAgreement(
      now, estimate.camera_from_map, inliers,
      {task.query.depth.noise_scale, estimator_.inlierThreshold2(), solidAngleOf(last_cone_rad)});
  findLeverage(task, hypothesis);
  evidence.centre_sigma_ratio = hypothesis->leverage.centre_sigma_ratio;
  hypothesis->outcome = judgePose(evidence, estimate, min_inliers_);
}

void HypothesisSearch::findLeverage(const PoseTask &task, Hypothesis *hypothesis) const {
  const uint32_t inliers = hypothesis->estimate.inliers;
  hypothesis->leverage = {};
  if (inliers >= kInliersBeyondChallenge) return;
  hypothesis->leverage = highestLeverage(hypothesis->matched.all(), hypothesis->estimate,
                                         1 + inliers / kInliersALeverage, task.query.deadline);
  if (hypothesis->leverage.is_known) return;
  work_.cuts |= kCutVerification;
  hypothesis->is_verified = false;
}

}  // namespace sphc
