// Matches of recent frames, carried along by odometry: where one frame shows too little, a few together show
// enough.
#pragma once
#include "runtime/base/arena.h"
#include "runtime/geometry/rigid.h"
#include "runtime/localizer/tuning.h"
#include "runtime/types/correspondence.h"

namespace sphc {

struct OldMatch {
  LiftedPoint lifted;                    // in the camera of the latest frame
  Vector3 depth_ray;                     // unit, same camera: along which its depth was measured
  double depth_variance, rest_variance;  // m^2: along that ray; of all else, each way
  uint32_t point_index;
  float quality;
  uint16_t age;  // frames ago
};

class History {
 public:
  static void layout(uint32_t capacity, Arena &state, History *history);

  void clear() { count_ = 0; }
  // The camera has moved since the frame before: takes all matches along, with their growing error, and drops those
  // that have become too old or too vague.
  void advance(const Rigid &now_from_before, double rotation_sigma_rad, double translation_sigma_m);
  // A match of the latest frame.  It stands for its map point from now on: the same wrong match seen in many frames
  // is no evidence.  The oldest one makes room where there is none.
  void add(const LiftedPoint &lifted, uint32_t point_index, float quality);

  Span<const OldMatch> matches() const { return matches_.first(count_); }
  // Frames that the matches come from.
  uint32_t frames() const;
  // What the odometry since then puts the matches of earlier frames off by, all of a frame together: 1 sigma an
  // axis, in the mean.
  void driftOfEarlier(double *turn_sigma_rad, double *shift_sigma_m) const;

 private:
  struct Drift {
    double turn_variance = 0, shift_variance = 0;
  };

  Span<OldMatch> matches_;  // in state
  uint32_t count_ = 0;
  Drift since_[tuning::kMostFramesTogether + 1];  // by age
};

}  // namespace sphc
