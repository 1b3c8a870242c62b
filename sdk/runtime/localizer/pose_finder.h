// Finds the pose of a frame in the maps: where it is expected, and in the whole maps where that fails.
#pragma once
#include "runtime/localizer/front_end.h"
#include "runtime/localizer/verification.h"

namespace sphc {

class PoseFinder {
 public:
  // A frame, and what is known of it beside its images; borrowed.
  struct Frame {
    FrontEnd *front = nullptr;
    Fusion *fusion = nullptr;
    const Tracker *tracker = nullptr;  // null where each frame is looked at alone
    DepthCalibration depth;            // of the depth sensor
    bool images_are_apart = false;     // in time, so that earlier frames do not help
  };

  // One walk for both memories; `finder` is null while measuring.
  static void layout(const LocalizerConfig &config, Arena &state, Arena &scratch, PoseFinder *finder);
  void init(const LocalizerConfig &config);
  MapSet &maps() { return search_.maps(); }
  const MapSet &maps() const { return search_.maps(); }
  const SearchParameters &parameters() const { return parameters_; }
  void setParameters(const SearchParameters &parameters);

  // The frame of the calls that follow.  There is no pose of it yet.
  void begin(const Frame &frame);
  // Makes best() what is found with all that is known, in place of what was found before.
  void find(const Known &known, const Deadline &deadline, Work *work);
  // Holds the whole map against best(), which was looked for where it was expected, by matches alone: what the
  // caller says may be wrong.  What the map does not confirm is ambiguous.  A frame may lack this step for its
  // deadline; then the pose may have a rival.
  void confirm(const Deadline &deadline, Work *work);
  // What the mirror image of the frame shows in the map of best(); good until the next search.
  const Hypothesis &findMirrored(const Deadline &deadline, Work *work);

  Hypothesis &best() { return best_; }
  const Hypothesis &best() const { return best_; }
  // What the frame is asked of a map with; `prior` is borrowed.
  PoseQuery queryFor(const PosePrior &prior, const Deadline &deadline) const;
  PoseEstimator &estimator() { return estimator_; }
  Ranking &ranking() { return ranking_; }
  const Ranking &ranking() const { return ranking_; }
  // Were all keypoints compared with whole maps, and in how many clear matches of one, at most?
  bool wasAsked() const { return was_asked_; }
  uint32_t clear() const { return clear_; }

 private:
  bool expects(const Known &known, double most_cone_rad, Prediction *expected) const;
  void searchNear(const Known &known, const Prediction &expected, const Deadline &deadline, Work *work);
  void searchEverywhere(const Known &known, const Deadline &deadline, Work *work);
  void searchMap(uint32_t map, bool remembers, const PoseQuery &query, Work *work);
  PoseTask taskOfWholeMap(uint32_t map, const PoseQuery &query, Work *work);
  void matchAll(uint32_t map, PoseTask *task, Work *work);
  bool searchMapByStrongest(uint32_t map, const PoseTask &task, Work *work);
  void searchMapLoosely(uint32_t map, const PoseTask &task, Work *work);
  void solve(const PoseTask &task, Work *work);
  Verification verification(uint32_t min_inliers, Work *work, Ranking *ranking);
  void propose();
  bool isDone(const Deadline &deadline, Work *work) const;

  SearchParameters parameters_;
  uint64_t seed_ = 0;
  Search search_;
  PoseEstimator estimator_;
  Repetition repetition_;
  // Of the frame.
  Frame frame_;
  Hypothesis best_, candidate_, rival_;  // their matches are in scratch
  Ranking ranking_;
  bool was_asked_ = false;
  uint32_t clear_ = 0;
};

}  // namespace sphc
