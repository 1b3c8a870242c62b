// Where in the maps to look: which of them, and there everywhere or near where a pose predicts each keypoint.
#pragma once
#include "runtime/base/fixed_vector.h"
#include "runtime/localizer/hypothesis.h"
#include "runtime/localizer/map_set.h"
#include "runtime/localizer/tracker.h"
#include "runtime/localizer/tuning.h"
#include "runtime/stages/match/matcher.h"
#include "runtime/types/cut.h"

namespace sphc {

using MapOrder = FixedVector<uint32_t, tuning::kMapsTried>;  // slots

// What a frame has cost so far.
struct Work {
  uint32_t samples = 0;  // minimal ones
  uint64_t match_ns = 0;
  Cuts cuts = 0;
};

// Half angle of the cone in which the matches of an expected pose are sought.
double coneOf(const Prediction &expected);
// In steradians, of a cone of this half angle.
double solidAngleOf(double cone_rad);
// Does the caller's pose narrow the search?
bool isNarrow(const Known &known);
// Where the camera should be: by the caller, else by earlier frames (`tracker` may be null) to within this cone;
// false where both say too little to narrow the search.
bool expectedPose(const Known &known, const Tracker *tracker, double most_cone_rad, Prediction *expected);

class Search {
 public:
  // A frame's keypoints, asked of one map; good until the next is made.
  struct Question {
    const FrontEnd *front = nullptr;
    const MapView *map = nullptr;
  };

  static void layout(const LocalizerConfig &config, Arena &state, Arena &scratch, Search *search);
  void init(const LocalizerConfig &config);
  void setParameters(const SearchParameters &parameters);
  MapSet &maps() { return maps_; }
  const MapSet &maps() const { return maps_; }
  const MapView &map(uint32_t slot) const { return maps_.view(slot); }
  float maxRatio() const { return max_ratio_; }

  // Which maps to search, the likeliest first.
  MapOrder rankMaps(const FrontEnd &front, const Deadline &deadline, Work *work);

  // About the first `keypoints`; in as many cells of the map's index.
  Question ask(const FrontEnd &front, uint32_t map, uint32_t keypoints, uint32_t probes, Work *work);
  // Matches the first `keypoints` with the whole map, by the configured ratio or by another.
  void matchEverywhere(const Question &question, uint32_t keypoints, const Deadline &deadline, MatchSet *matched,
                       Work *work) {
    matchEverywhere(question, keypoints, max_ratio_, deadline, matched, work);
  }
  void matchEverywhere(const Question &question, uint32_t keypoints, float max_ratio, const Deadline &deadline,
                       MatchSet *matched, Work *work);
  // How many cells to ask for of each of so many keypoints, so that they are answered by then; the configured
  // number where there is time.
  uint32_t probesWithin(uint32_t keypoints, const Deadline &deadline, Work *work) const;
  bool hasTimeNear(uint32_t keypoints, const Deadline &deadline) const {
    return matcher_.hasTimeNear(keypoints, deadline);
  }
  // Of the first `keypoints`, as many as matchEverywhere can answer by then; or those that it has answered.
  uint32_t answerable(uint32_t keypoints, const Deadline &deadline) const {
    return matcher_.answerable(keypoints, deadline);
  }
  // Matches each keypoint with depth in a cone around where the pose predicts it.  Without depth a pose does not
  // say where to look: those matches are `rays`, of matchEverywhere.
  void matchNear(const Question &question, const Rigid &camera_from_map, double cone_rad, Span<const Match> rays,
                 const Deadline &deadline, MatchSet *matched, Work *work);
  // Everywhere by the configured ratio, but for the keypoints of these matches; of the first `keypoints`.
  void matchOthers(const Question &question, uint32_t keypoints, Span<const Match> taken, const Deadline &deadline,
                   MatchSet *matched, Work *work);
  // Of these matches those of keypoints without depth; in memory of the search, until a call that does not keep
  // them.
  Span<const Match> raysOf(const FrontEnd &front, const MatchSet &matched, Span<const Match> kept = {});

 private:
  uint32_t countVotes(const FrontEnd &front, uint32_t map, uint32_t voters, const Deadline &deadline, Work *work);
  uint32_t match(uint32_t keypoints, float max_ratio, const Deadline &deadline, Span<Match> room, Work *work);
  void account(int64_t begin_ns, Work *work) const;

  MapSet maps_;
  Span<uint32_t> votes_;  // of each slot; in scratch
  float max_ratio_ = 0;
  uint32_t probes_ = 0;
  Clock clock_;
  Matcher matcher_;
  // In scratch.
  Span<Direction> predicted_;
  Span<uint8_t> is_taken_;  // of each keypoint
  Span<Match> rays_;        // and those of votes, which are only counted
  Span<Match> other_rays_;  // while those are kept
};

}  // namespace sphc
