// From matches to a pose that is to be believed, or not: a hypothesis (hypothesis_search.h), then verification
// against its rivals: what another search finds, what is found without its high-leverage observations, the second
// pose of a planar scene, and what the other keypoints speak for.  An independent search must confirm it, and one
// of few inliers must hold without a part of them.  A pose that lacks one of these for its deadline is uncertain.
// In the end, where what is seen repeats, and there is time, it is compared with what is found without all that
// repeats, and with poses that are off by the period.  What all that finds no pose of is searched once more, among
// the matches of a looser ratio test.
#pragma once
#include "runtime/localizer/hypothesis_search.h"
#include "runtime/localizer/repetition.h"

namespace sphc {

class Verification {
 public:
  Verification(Search *search, PoseEstimator *estimator, Repetition *repetition, const Fusion *fusion,
               uint32_t min_inliers, bool tracks, Work *work, Ranking *ranking)
      : hypotheses_(search, estimator, fusion, min_inliers, work, ranking),
        search_(*search),
        estimator_(*estimator),
        repetition_(*repetition),
        tracks_(tracks),
        work_(*work) {}

  // `found` has its first matches.  It becomes the best hypothesis they lead to, and judged; `rival` is memory for
  // others.
  void findPose(const PoseTask &task, Hypothesis *found, Hypothesis *rival) const;
  // The same from the matches of a looser ratio test, for a frame that findPose finds no pose of.
  void findPoseLoosely(const PoseTask &task, Hypothesis *found, Hypothesis *rival) const;
  // Nothing is verified, so the pose is evidence and no answer.
  void findUnverifiedPose(const PoseTask &task, Hypothesis *found) const;

 private:
  // Inliers with depth, and how many of them are of what does not repeat.
  struct Support {
    uint32_t inliers = 0, unrepeated = 0;
  };

  void verify(const PoseTask &task, Hypothesis *found, Hypothesis *rival) const;
  bool isDoubtful(const Hypothesis &found) const;
  void searchAgain(const PoseTask &task, uint64_t spent_ns, Hypothesis *found, Hypothesis *rival) const;
  bool challengeBySearch(const PoseTask &task, Hypothesis *found, Hypothesis *rival) const;
  void challengeByOthers(const PoseTask &task, Hypothesis *found, Hypothesis *rival) const;
  bool repeats(const Hypothesis &found, uint32_t match) const;
  Support supportOf(const Hypothesis &found) const;
  void challengeRepeated(const PoseTask &task, Hypothesis *found, Hypothesis *rival) const;
  bool replaceByUnrepeated(const PoseTask &task, Hypothesis *found, Hypothesis *rival) const;
  bool mayBeginTrack(const PoseTask &task, const Hypothesis &found) const;
  void challengeByPeriod(const PoseTask &task, Hypothesis *found, Hypothesis *rival) const;
  void confirm(const PoseTask &task, Hypothesis *found, Hypothesis *rival) const;
  bool searchWithout(const Leverage &leverage, const PoseTask &task, const Hypothesis &found,
                     Hypothesis *rival) const;
  bool searchAmong(const PoseTask &task, Hypothesis *rival) const;
  void challengeWithoutLeverage(const PoseTask &task, Hypothesis *found, Hypothesis *rival) const;
  void challengeFew(const PoseTask &task, Hypothesis *found, Hypothesis *rival) const;
  void challengeMirrored(const PoseTask &task, Hypothesis *found, Hypothesis *rival) const;

  HypothesisSearch hypotheses_;
  Search &search_;
  PoseEstimator &estimator_;
  Repetition &repetition_;
  bool tracks_;
  Work &work_;
};

}  // namespace sphc
