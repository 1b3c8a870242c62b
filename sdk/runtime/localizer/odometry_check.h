// Odometry against poses: how the camera moved, by each.  Odometry of other axes, the inverse of a pose, and what
// stands still move otherwise, again and again.
#pragma once
#include "runtime/localizer/hypothesis.h"
#include "runtime/localizer/tracker.h"

namespace sphc {

class OdometryCheck {
 public:
  void reset() {
    has_last_ = false;
    contradictions_ = steps_apart_ = 0;
  }
  // The map in this slot is gone.
  void forget(uint32_t map) {
    if (map == looks_[last_].map) reset();
  }
  // Before each frame; a time that does not grow starts anew.
  void advance(int64_t time_ns) {
    if (time_ns <= now_ns_) reset();
    now_ns_ = time_ns;
  }
  // After it; `found` is what the frame shows, before earlier ones speak against it.
  void look(const Known &known, const Hypothesis &found);
  // By the last look, and where time goes on: is odometry not to be believed?
  bool disagrees() const;

 private:
  // Where the camera was, by both, and how their frames lie to each other if both are right.
  struct Look {
    uint32_t map = 0;
    int64_t time_ns = 0;
    Rigid odometry_from_map;
    Vector3 centre_in_map_m, centre_in_odometry_m;
    double pose_turn = 0, pose_shift = 0;          // 1 sigma an axis, rad and m
    double odometry_turn = 0, odometry_shift = 0;  // variances of an axis; they add up from look to look
  };
  static bool contradict(const Look &before, const Look &now);
  bool follows(const Look &now) const;
  uint32_t unused() const;
  void compare(uint32_t number);

  bool has_last_ = false;
  Look looks_[3];                   // none is copied
  uint32_t last_ = 0, anchor_ = 0;  // the last frame with a pose, and the one that it is compared with
  double turn_variance_ = 0, shift_variance_ = 0;  // of all steps of odometry
  uint32_t contradictions_ = 0, steps_apart_ = 0;  // the latter in a row
  int64_t contradicted_ns_ = 0, now_ns_ = INT64_MIN;
};

}  // namespace sphc
