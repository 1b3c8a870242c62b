// Was this place seen before?  One comparison a frame; a loop is believed when two agree on it.
#pragma once
#include "host/guide/places.h"

namespace sphc::host {

// A frame whose place is known within its part.
struct Located {
  const WalkFrame *frame = nullptr;
  uint32_t place = 0;  // the last that it follows
  Rigid part_from_camera;
};

// Two views of one place, much apart in time, or in parts that had not met.
struct FoundLoop {
  uint32_t place = 0;  // the earlier one
  uint32_t inliers = 0;
  Rigid camera_from_place;
};

class LoopSearch {
 public:
  explicit LoopSearch(Places *places) : places_(*places) {}

  // None mostly.  A loop is told when a frame agrees with an earlier place, and then another pair of views does on
  // the same transform.
  std::optional<FoundLoop> look(const Located &here);
  // When what went before does not hold any more.
  void forget();

 private:
  // A loop that one pair of views speaks for.
  struct Claim {
    uint32_t place = 0, seen_from = 0;  // two places
    uint32_t part = 0;                  // of the frame that saw it
    Rigid part_from_place;
    int tries = 0;
  };
  bool mayBe(uint32_t place, const Located &here) const;
  void chooseCandidates(const Located &here);
  std::optional<uint32_t> nextWitness(const Located &here);
  std::optional<FoundLoop> askWitness(const Located &here);
  void askCandidate(const Located &here);

  Places &places_;
  std::vector<uint32_t> candidates_;  // the best last
  uint32_t candidates_of_ = UINT32_MAX;
  std::optional<Claim> claim_;
};

}  // namespace sphc::host
