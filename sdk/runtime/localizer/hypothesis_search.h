// From matches to a hypothesis: robust search among them, then guided re-matching with what the pose predicts. What
// comes out is judged by its own evidence, and ranked; verification.h holds it against its rivals.
#pragma once
#include "runtime/localizer/fusion.h"
#include "runtime/localizer/ranking.h"
#include "runtime/localizer/search.h"
#include "runtime/stages/pose/estimator.h"

namespace sphc {

// What the hypotheses of one search have in common.
struct PoseTask {
  Search::Question question;        // the frame and the map
  Span<const Match> rays;           // matches of keypoints without depth
  PoseQuery query;                  // without the correspondences, which are the hypothesis's
  double solid_angle_sr = 0;        // in which the first matches were looked for
  Span<const double> cones_rad;     // of guided re-matching, one after another
  float max_ratio = 0;              // of the first matches, where it is not the configured one
  const Rigid *expected = nullptr;  // camera from map, by a track; null where none says
};

// The task's query, with these correspondences.
PoseQuery queryAbout(const PoseTask &task, const MatchSet &matched);

class HypothesisSearch {
 public:
  HypothesisSearch(Search *search, PoseEstimator *estimator, const Fusion *fusion, uint32_t min_inliers, Work *work,
                   Ranking *ranking)
      : search_(*search),
        estimator_(*estimator),
        fusion_(*fusion),
        min_inliers_(min_inliers),
        work_(*work),
        ranking_(*ranking) {}

  // Before a step of verification: is there no time for it?  Then the work is cut.
  bool isCut(const PoseTask &task) const;
  // Before a step without which the pose is not verified.
  bool isLeftOut(const PoseTask &task, Hypothesis *found) const;

  // Of all keypoints, how many can be matched everywhere in a share of the time that is left?
  uint32_t answerable(const PoseTask &task) const;
  // Finds the pose that most of the hypothesis's matches agree with; false where they agree with none.
  bool search(const PoseTask &task, Hypothesis *hypothesis) const;
  // The same among the matches that all keypoints have at this ratio, in another order than the first search did,
  // by what is known of the pose (null: nothing).  `other` becomes the task of these matches.
  bool searchOtherMatches(const PoseTask &task, const PosePrior *prior, float max_ratio, Hypothesis *hypothesis,
                          PoseTask *other) const;
  // Matches again near where the hypothesis's pose predicts each keypoint, refines the pose, and judges it.
  void rematch(const PoseTask &task, Hypothesis *hypothesis) const;

 private:
  void matchInCones(const PoseTask &task, Hypothesis *hypothesis) const;
  void judge(const PoseTask &task, Hypothesis *hypothesis) const;
  void findLeverage(const PoseTask &task, Hypothesis *hypothesis) const;

  Search &search_;
  PoseEstimator &estimator_;
  const Fusion &fusion_;
  uint32_t min_inliers_;
  Work &work_;
  Ranking &ranking_;
};

}  // namespace sphc
