// Odometry against poses: how the camera moved, by each.  Odometry of other axes, the inverse of a pose, and what
// stands still move otherwise, again and again.
#pragma once
#include "runtime/localizer/hypothesis.h"
#include "runtime/localizer/tracker.h"

namespace sphc {

class OdometryCheck {
 public:
  void reset() { *this = {}; }
  // The map in this slot is gone.
  void forget(uint32_t map) {
    if (map == last_.map) reset();
  }
  // Every frame; `found` is what the frame shows, before earlier ones speak against it.  A time that does not grow
  // starts anew.
  void look(int64_t time_ns, const Known &known, const Hypothesis &found);
  // By the last look: is odometry not to be believed?
  bool disagrees() const;

 private:
  // Variances of an axis, rad^2 and m^2; those of odometry add up from look to look.
  struct Look {
    uint32_t map = 0;
    int64_t time_ns = 0;
    Rigid camera_from_map, odometry_from_camera;
    double pose_turn = 0, pose_shift = 0, odometry_turn = 0, odometry_shift = 0;
  };
  static bool contradict(const Look &before, const Look &now);
  bool follows(const Look &now) const;
  void compare(const Look &now);

  bool has_last_ = false;
  Look last_, anchor_;  // the last frame with a pose, and the one that it is compared with
  double turn_variance_ = 0, shift_variance_ = 0;  // of all steps of odometry
  uint32_t contradictions_ = 0, steps_apart_ = 0;  // the latter in a row
  int64_t contradicted_ns_ = 0, now_ns_ = INT64_MIN;
};

}  // namespace sphc
