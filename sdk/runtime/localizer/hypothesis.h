// A pose that a frame may have, with everything that was found for it.  Each hypothesis has memory of its own, so
// two can be compared and swapped, and nothing is found twice.
#pragma once
#include "runtime/base/arena.h"
#include "runtime/localizer/front_end.h"
#include "runtime/localizer/judgement.h"
#include "runtime/localizer/tuning.h"
#include "runtime/map/map_view.h"
#include "runtime/stages/pose/leverage.h"
#include "runtime/types/match.h"

namespace sphc {

// Matches of a frame with a map as correspondences, and behind them correspondences of earlier frames.
class MatchSet {
 public:
  static void layout(uint32_t max_keypoints, Arena &scratch, MatchSet *matches);

  void clear() { match_count_ = count_ = 0; }
  // Where a matcher writes; then `assign` says how many it wrote.
  Span<Match> room() { return matches_; }
  void assign(uint32_t count, const FrontEnd &front, const MapView &map);
  // Of an earlier frame.
  void add(const Correspondence &correspondence) { correspondences_[count_++] = correspondence; }

  Span<const Match> matches() const { return matches_.first(match_count_); }
  Span<const Correspondence> ofThisFrame() const { return correspondences_.first(match_count_); }
  Span<const Correspondence> all() const { return correspondences_.first(count_); }

 private:
  Span<Match> matches_;
  Span<Correspondence> correspondences_;
  uint32_t match_count_ = 0, count_ = 0;
};

struct Hypothesis {
  bool tried = false;   // false: nothing was looked for yet
  uint32_t map = 0;     // its slot
  bool guided = false;  // looked for where a pose was expected, not in the whole map
  uint32_t frames = 1;  // whose matches were put together
  Outcome outcome = Outcome::kFewMatches;
  Estimate searched;  // by robust search among the first matches
  Estimate estimate;  // after guided re-matching
  Evidence evidence;
  Leverage leverage;
  bool is_verified = true;    // false where a deadline left out what might have spoken against it
  bool is_ambiguous = false;  // uncertain since another pose fits nearly as well, or for odometry
  // Another pose fits well, but not nearly as well; or there was no time to look, or it was so a moment ago.
  bool has_near_rival = false;
  bool has_doubtful_focal = false;  // its matches scatter as if of another focal length
  MatchSet matched;

  bool isLocalized() const { return outcome == Outcome::kLocalized; }
  // More than chance explains, be it too vague or ambiguous to be believed.
  bool hasPose() const { return isLocalized() || outcome == Outcome::kUncertain; }
  void doubtForRival() {
    outcome = Outcome::kUncertain;
    is_ambiguous = true;
  }
  // Another attempt, in the same memory.
  void begin(uint32_t map_slot, uint32_t frame_count = 1);
  // All of the other but its matches.
  void challenge(const Hypothesis &other);
};

void swap(Hypothesis &a, Hypothesis &b);

// Are two poses that a frame may have one, to within these bounds?
bool areNear(const Rigid &a, const Rigid &b, const tuning::PoseBounds &bounds);
// A match, and how clearly it beat the runner-up.
Correspondence correspondenceOf(const Match &match, const FrontEnd &front, const MapView &map);
Vector3 directionOf(const MapView &map, uint32_t point_index);

}  // namespace sphc
