#include "runtime/localizer/verification.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "runtime/localizer/tuning.h"

namespace sphc {

using namespace tuning;

namespace {

static_assert(kFewInliers / 3 <= kMostHighLeverage, "of few inliers a third may be left out");

void copyWithout(const Leverage &leverage, const Hypothesis &from, MatchSet *matched) {
  const auto begin = leverage.indices.begin(), end = leverage.indices.end();
  const Span<const Correspondence> all = from.matched.all();
  for (uint32_t i = 0; i < all.size(); ++i)
    if (std::find(begin, end, i) == end) matched->add(all[i]);
}

}  // namespace

void Verification::findPose(const PoseTask &task, Hypothesis *found, Hypothesis *rival) const {
  const uint64_t left_ns = task.query.deadline.leftNs();
  if (!hypotheses_.search(task, found)) return;
  hypotheses_.rematch(task, found);
  searchAgain(task, left_ns - std::min(left_ns, task.query.deadline.leftNs()), found, rival);
  verify(task, found, rival);
}

// The strict ratio test may leave so few true matches that chance could explain them.  A looser one brings more of
// them, and wrong ones, which the test of chance counts.
void Verification::findPoseLoosely(const PoseTask &task, Hypothesis *found, Hypothesis *rival) const {
  if (search_.maxRatio() >= kLooserRatio || hypotheses_.isCut(task)) return;
  PoseTask other;
  if (!hypotheses_.searchOtherMatches(task, task.query.prior, kLooserRatio, found, &other)) return;
  found->evidence.log_chance_first += logOf(2);  // the better of two searches
  hypotheses_.rematch(other, found);
  verify(other, found, rival);
}

void Verification::findUnverifiedPose(const PoseTask &task, Hypothesis *found) const {
  if (hypotheses_.search(task, found)) hypotheses_.rematch(task, found);
}

// A pose that was found, against its rivals.
void Verification::verify(const PoseTask &task, Hypothesis *found, Hypothesis *rival) const {
  challengeWithoutLeverage(task, found, rival);
  challengeMirrored(task, found, rival);
  challengeByOthers(task, found, rival);
  confirm(task, found, rival);
  challengeFew(task, found, rival);
  challengeRepeated(task, found, rival);
  if (found->isLocalized() && !found->is_verified) found->outcome = Outcome::kUncertain;
}

// Makes the rival what is found without some of a pose's matches; false where nothing is.
bool Verification::searchWithout(const Leverage &leverage, const PoseTask &task, const Hypothesis &found,
                                 Hypothesis *rival) const {
  rival->challenge(found);
  copyWithout(leverage, found, &rival->matched);
  return searchAmong(task, rival);
}

// Makes the rival what its matches lead to; false where that is nothing.
bool Verification::searchAmong(const PoseTask &task, Hypothesis *rival) const {
  rival->estimate = estimator_.search(queryAbout(task, rival->matched));
  work_.samples += rival->estimate.iterations;
  if (rival->estimate.inliers <= kFewestMatches / 2) return false;
  hypotheses_.rematch(task, rival);
  return true;
}

// A pose may rest on one or two wrong matches, far from the others, that turn it by degrees: the better of it and
// what is found without them stays.
void Verification::challengeWithoutLeverage(const PoseTask &task, Hypothesis *found, Hypothesis *rival) const {
  if (found->leverage.centre_sigma_ratio < kRestsOnFew) return;
  if (hypotheses_.isLeftOut(task, found)) return;
  if (searchWithout(found->leverage, task, *found, rival) && rival->estimate.gain > found->estimate.gain)
    swap(*found, *rival);
}

// Of few inliers more than two may be wrong: a right pose is found again without them, and where another one is
// that gains nearly as much, or more, nobody can tell.
void Verification::challengeFew(const PoseTask &task, Hypothesis *found, Hypothesis *rival) const {
  const uint32_t inliers = found->estimate.inliers;
  if (found->guided || inliers >= kFewInliers) return;
  for (const uint32_t one_in : kLeftOutOfFew) {
    if (!found->isLocalized() || hypotheses_.isLeftOut(task, found)) return;
    const Leverage leverage =
        highestLeverage(found->matched.all(), found->estimate, inliers / one_in, task.query.deadline);
    if (!leverage.is_known && hypotheses_.isLeftOut(task, found)) return;
    if (searchWithout(leverage, task, *found, rival) &&
        !areNear(rival->estimate.camera_from_map, found->estimate.camera_from_map, kSamePoseOfFew) &&
        rival->estimate.gain > kNearlyAsGoodOfFew * found->estimate.gain)
      found->doubtForRival();
  }
}

// A planar scene far from the centre has a second pose, which the few first matches may prefer.  Both are asked of
// all that guided re-matching brought; where they are nearly alike, nobody can tell.
void Verification::challengeMirrored(const PoseTask &task, Hypothesis *found, Hypothesis *rival) const {
  if (!found->isLocalized() || found->guided) return;
  rival->challenge(*found);
  rival->estimate = estimator_.refineMirrored(queryAbout(task, found->matched), found->estimate.camera_from_map);
  const double gain = found->estimate.gain;
  const Rigid apart = rival->estimate.camera_from_map * found->estimate.camera_from_map.inverse();
  if (rival->estimate.gain < kNearlyAsGood * gain || rotationAngle(apart.rotation) < kSamePoseRad) return;
  if (hypotheses_.isLeftOut(task, found)) return;
  hypotheses_.rematch(task, rival);
  const double rival_gain = rival->estimate.gain;
  if (rival_gain > gain) swap(*found, *rival);
  if (std::min(gain, rival_gain) > kNearlyAsGood * std::max(gain, rival_gain)) found->doubtForRival();
}

// Keypoints that do not speak for the pose, of earlier frames too, may speak for another one as clearly: where
// things stand in the room twice, or where some of what is seen goes with the camera, as its holder's feet do.  A
// pose of many inliers may lack this for its deadline.
void Verification::challengeByOthers(const PoseTask &task, Hypothesis *found, Hypothesis *rival) const {
  const uint32_t inliers = found->estimate.inliers;
  if (!found->isLocalized() || found->guided || inliers >= kInliersBeyondOthers) return;
  const bool has_many = inliers >= kInliersSeldomWrong;
  if (has_many ? hypotheses_.isCut(task) : hypotheses_.isLeftOut(task, found)) return;
  const ChallengeByOthers &way = has_many ? kOfManyInliers : kOfFewInliers;
  PoseTask other = task;
  other.query.seed += kOtherSeed;
  other.query.deadline = task.query.deadline.afterShare(kAgainShare);
  other.query.most_samples = way.most_samples;
  other.rays = {};
  rival->begin(found->map, found->frames);
  uint32_t taken = 0;
  for (uint32_t i = 0; i < found->matched.matches().size(); ++i)
    if (estimator_.isInlier(found->matched.ofThisFrame()[i], found->estimate))
      rival->matched.room()[taken++] = found->matched.matches()[i];
  const uint32_t keypoints = std::min(hypotheses_.answerable(other), way.most_keypoints);
  search_.matchOthers(task.question, keypoints, rival->matched.room().first(taken), other.query.deadline,
                      &rival->matched, &work_);
  const Span<const Correspondence> all = found->matched.all();
  for (size_t i = found->matched.matches().size(); i < all.size(); ++i)
    if (!estimator_.isInlier(all[i], found->estimate)) rival->matched.add(all[i]);
  if (!challengeBySearch(other, found, rival)) return;
  const double share = rival->estimate.gain / found->estimate.gain;
  if (share > way.ambiguous_gain) return found->doubtForRival();
  found->has_near_rival = share > kGainOfNearRival;
}

// The pose that the rival's matches lead to, if it is another one, against the one that was found: the better
// stays.
bool Verification::challengeBySearch(const PoseTask &task, Hypothesis *found, Hypothesis *rival) const {
  if (!hypotheses_.search(task, rival) || rival->evidence.log_chance_first > kMostLogChanceOfRival) return false;
  hypotheses_.rematch(task, rival);
  if (!rival->isLocalized() || areNear(rival->estimate.camera_from_map, found->estimate.camera_from_map, kSamePose))
    return false;
  if (rival->estimate.gain > found->estimate.gain) swap(*found, *rival);
  return true;
}

// Is there the like of this match's keypoint elsewhere in the frame?
bool Verification::repeats(const Hypothesis &found, uint32_t match) const {
  return found.matched.ofThisFrame()[match].lifted.hasDepth() &&
         repetition_.repeats(found.matched.matches()[match].query);
}

// Of this frame's matches.
Verification::Support Verification::supportOf(const Hypothesis &found) const {
  Support support;
  for (uint32_t i = 0; i < found.matched.matches().size(); ++i) {
    if (!estimator_.isInlier(found.matched.ofThisFrame()[i], found.estimate)) continue;
    ++support.inliers;
    support.unrepeated += !repeats(found, i);
  }
  return support;
}

// What repeats agrees with many poses, with a wrong one by chance more than with the right one.  The last step; a
// pose may lack it, and challengeByOthers of many inliers, for its deadline.
void Verification::challengeRepeated(const PoseTask &task, Hypothesis *found, Hypothesis *rival) const {
  const uint32_t inliers = found->estimate.inliers;
  if (!found->isLocalized() || inliers >= kInliersBeyondPattern) return;
  const bool is_known =
      found->guided && inliers >= kAgreeingOfKnown * static_cast<double>(found->matched.all().size());
  if (is_known && inliers >= kInliersBeyondConfirmation) return;
  if (hypotheses_.isCut(task) ||
      (!repetition_.look(*task.question.front, task.query.deadline) && hypotheses_.isCut(task)))
    return;
  if (repetition_.moves_m().empty()) return;
  if (replaceByUnrepeated(task, found, rival)) {
    confirm(task, found, rival);
    challengeFew(task, found, rival);
  }
  if (!is_known) challengeByPeriod(task, found, rival);
}

// Matches of a pattern that agree by chance may draw a pose away from the few others.  Where another one is found
// without all that repeats, the better of the two stays.  True where that is the other one.
bool Verification::replaceByUnrepeated(const PoseTask &task, Hypothesis *found, Hypothesis *rival) const {
  if (hypotheses_.isCut(task)) return false;
  rival->challenge(*found);
  const Span<const Correspondence> all = found->matched.all();
  const size_t of_this_frame = found->matched.matches().size();
  for (uint32_t i = 0; i < all.size(); ++i)
    if (i >= of_this_frame || !repeats(*found, i)) rival->matched.add(all[i]);
  if (!searchAmong(task, rival) || !rival->isLocalized() || !rival->is_verified) return false;
  if (rival->estimate.gain <= found->estimate.gain ||
      areNear(rival->estimate.camera_from_map, found->estimate.camera_from_map, kSamePoseUnrepeated))
    return false;
  swap(*found, *rival);
  return true;
}

// Of a session that tracks: is the pose another one than that of the track?
bool Verification::mayBeginTrack(const PoseTask &task, const Hypothesis &found) const {
  if (!tracks_ || found.guided) return false;
  return !task.expected || !areNear(found.estimate.camera_from_map, *task.expected, kSamePose);
}

// A pose is ambiguous where one that is off by the period of what is seen, once or twice, gains nearly as much, and
// what does not repeat speaks no less for that one; half as much where a track may begin with the pose.  This is
// not asked where the inliers scatter about the pose as they do by chance, nor where nearly all of them repeat:
// there half of the gain is enough.
void Verification::challengeByPeriod(const PoseTask &task, Hypothesis *found, Hypothesis *rival) const {
  if (!found->isLocalized()) return;
  const Support own = supportOf(*found);
  const bool is_repeated = own.unrepeated < kFewestUnrepeated && own.unrepeated < kLeastUnrepeated * own.inliers;
  const bool is_scattered = found->estimate.gain < kLeastMeanGain * found->estimate.inliers;
  const double share = is_repeated ? kRepeatedGain : kPeriodGain;
  const double most_unrepeated = (mayBeginTrack(task, *found) ? kUnrepeatedToTrack : 1) * own.unrepeated;
  PoseTask near = task;
  near.cones_rad = {kConesOfExpectedPose, 1};
  for (const Vector3 &move_m : repetition_.moves_m()) {
    for (const int times : {-1, 1, -2, 2}) {
      if (hypotheses_.isCut(task)) return;
      rival->challenge(*found);
      rival->estimate.camera_from_map.translation_m += times * move_m;
      // Nobody searched for it: what speaks for it is what re-matching shows.
      rival->evidence.source = MatchSource::kExpected;
      rival->evidence.log_chance_first = -std::numeric_limits<double>::infinity();
      hypotheses_.rematch(near, rival);
      const PoseBounds same = {move_m.norm() / 2, kSamePose.most_turn_rad};
      const double gain = rival->estimate.gain / found->estimate.gain;
      if (gain <= std::min(share, kPeriodGainOfNearRival) ||
          areNear(rival->estimate.camera_from_map, found->estimate.camera_from_map, same))
        continue;
      const uint32_t unrepeated = supportOf(*rival).unrepeated;
      if (gain > share && (is_repeated || is_scattered || unrepeated >= most_unrepeated))
        return found->doubtForRival();
      if (!found->guided && unrepeated >= kUnrepeatedOfNearRival * own.unrepeated) found->has_near_rival = true;
    }
  }
}

// Few matches may agree by more than uniform chance where textures resemble themselves; a pose that was looked for
// where it was expected has the expectation to speak for it.
bool Verification::isDoubtful(const Hypothesis &found) const {
  return found.isLocalized() && !found.guided && found.estimate.inliers < kInliersBeyondConfirmation;
}

// The first search took the strongest keypoints, or ended with the first pose that chance could not explain: where
// few matches agree, the better of it and what a second search finds stays.  That takes what the first one did, so
// confirmation goes before it where time is short.
void Verification::searchAgain(const PoseTask &task, uint64_t spent_ns, Hypothesis *found,
                               Hypothesis *rival) const {
  if (!isDoubtful(*found) || hypotheses_.isCut(task)) return;
  const Deadline &deadline = task.query.deadline;
  if (deadline.isSet() && kAgainShare * static_cast<double>(deadline.leftNs()) < static_cast<double>(spent_ns)) {
    work_.cuts |= kCutVerification;
    return;
  }
  PoseTask own = task, other;
  own.query.deadline = deadline.afterShare(kAgainShare);
  rival->begin(found->map, found->frames);
  if (!hypotheses_.searchOtherMatches(own, own.query.prior, search_.maxRatio(), rival, &other)) return;
  hypotheses_.rematch(other, rival);
  if (rival->estimate.gain > found->estimate.gain) swap(*found, *rival);
}

// A looser ratio test brings other true matches and other wrong ones.  The right pose is found among them again;
// one that agrees by chance drowns.  The matches that a pose was found by are no second witness, and what the
// caller knows is none: a wrong vertical would lead both searches to one pose.
void Verification::confirm(const PoseTask &task, Hypothesis *found, Hypothesis *rival) const {
  if (!isDoubtful(*found)) return;
  bool has_rival = false;
  for (const ConfirmingSearch &way : kConfirmingSearches) {
    if (task.max_ratio >= way.max_ratio) continue;
    if (hypotheses_.isCut(task)) break;
    PoseTask other;
    rival->begin(found->map, found->frames);
    const float max_ratio = std::max(way.max_ratio, search_.maxRatio());
    if (!hypotheses_.searchOtherMatches(task, nullptr, max_ratio, rival, &other)) continue;
    const Rigid &pose = rival->estimate.camera_from_map;
    if (areNear(pose, found->estimate.camera_from_map, way.agreement)) return;
    has_rival = has_rival || (rival->evidence.log_chance_first <= kMostLogChanceOfRival &&
                              !areNear(pose, found->estimate.camera_from_map, kSamePose));
  }
  found->outcome = Outcome::kUncertain;
  found->is_ambiguous = has_rival;
}

}  // namespace sphc
