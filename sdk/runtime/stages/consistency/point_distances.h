// How far map points lie from the map's centroid.  A sphere cloud does not say; depth does, and it says the same
// from everywhere if the sensor is sound, its calibration holds, and the poses are right.
#pragma once
#include "runtime/base/arena.h"
#include "runtime/geometry/rotation.h"

namespace sphc {

// By a frame and its pose.
struct PointDistance {
  uint32_t point_index = 0;
  double distance_m = 0, variance_m2 = 0;
};

class PointDistances {
 public:
  static void layout(Arena &state, PointDistances *distances);

  // Once, after layout with memory; and to forget all frames.
  void reset();
  // A frame from this place.
  void begin(const Vector3 &centre_in_map_m, int64_t time_ns);
  // One of its points with what an earlier frame, from elsewhere, said of it.
  void compare(const PointDistance &seen);
  // After all of its points: do most of them lie elsewhere than they did?
  bool disagree() const { return compared_ >= kFewest && 2 * apart_ > compared_; }
  // Keeps one of its points, unless an earlier frame's is there.
  void keep(const PointDistance &seen);

 private:
  static constexpr uint32_t kCapacity = 512, kFewest = 6;
  struct Known {
    uint32_t point_index;
    float distance_m, variance_m2;
    Eigen::Vector3f centre_m;  // of the camera that saw it
    int64_t time_ns;
  };
  Known &slotOf(uint32_t point_index) const { return known_[point_index % kCapacity]; }
  bool isOf(const Known &known, uint32_t point_index) const;

  Span<Known> known_;  // in state; of the points that share a slot the last one
  Eigen::Vector3f centre_m_ = Eigen::Vector3f::Zero();
  int64_t time_ns_ = 0;
  uint32_t compared_ = 0, apart_ = 0;  // of this frame
};

}  // namespace sphc
