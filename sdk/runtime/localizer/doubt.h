// What speaks against a pose beside its matches: the vertical, odometry, earlier frames, and what the depth sensor
// was said to be.
#pragma once
#include "runtime/localizer/hypothesis.h"
#include "runtime/localizer/tracker.h"
#include "runtime/stages/consistency/point_distances.h"
#include "runtime/stages/consistency/travel.h"
#include "runtime/stages/pose/estimator.h"

namespace sphc {

// Has the pose that the matches alone speak for the vertical that was given?  Unknown where there is no such pose.
// `query` has no prior; its correspondences are set here.
enum class Vertical : uint8_t { kUnknown, kAgrees, kDisagrees };
Vertical compareVertical(const Known &known, const Hypothesis &found, PoseQuery query, uint32_t min_inliers,
                         PoseEstimator *estimator);

// Has more been learnt of the depth sensor than a sound one could have?
bool isBeyondPrior(const DepthCalibration &learnt, const DepthCalibration &prior);

// Do the matches of a pose agree with another focal length of the colour camera?  Doubtful where they scatter as
// if, on a plane that tells of none: more of such poses are wrong.  `depth` is what was known of the sensor before
// the frame.
enum class FocalLength : uint8_t { kAgrees, kDoubtful, kDisagrees };
FocalLength compareFocalLength(const Hypothesis &found, const DepthCalibration &depth, const Deadline &deadline);

// The confidence that the pose's rivals, these faults and, of edges, a doubt too small for a fault leave it.
double doubted(double confidence, const Hypothesis &found, Faults faults, bool edges_are_doubtful);

// A common scale of all depths shows in how far the camera goes, and only there.
class TravelCheck {
 public:
  void reset() {
    travel_.reset();
    way_variance_m2_ = 0;
    was_scaled_ = false;
  }
  // The map in this slot is gone.
  void forget(uint32_t map) {
    if (map == map_) reset();
  }
  // Every frame that follows another; `tracker` knows of the frame.
  bool isScaled(const Known &known, const Tracker &tracker, const Hypothesis &found);
  // When there last was a pose to tell?
  bool wasScaled() const { return was_scaled_; }

 private:
  Travel travel_;
  double way_variance_m2_ = 0;  // of odometry along an axis, since the last frame with a pose
  bool was_scaled_ = false;
  uint32_t map_ = 0;
};

// A map point that stands still keeps its distance, be it seen from here or there.
class DistanceCheck {
 public:
  static void layout(Arena &state, DistanceCheck *check) {
    PointDistances::layout(state, check ? &check->distances_ : nullptr);
  }
  // Once, after layout with memory; and to forget all frames.
  void reset() {
    distances_.reset();
    disagrees_ = false;
  }
  // The map in this slot is gone.
  void forget(uint32_t map) {
    if (map == map_) reset();
  }
  // Every frame that has a pose; a time that does not grow starts anew.  Earlier frames may be those that were
  // wrong: when their word has stood against all that followed for kForgetNs, it is forgotten.
  bool disagrees(int64_t time_ns, const Hypothesis &found, const PoseEstimator &estimator);
  // After it, where the pose is believed.
  void keep(const Hypothesis &found, const PoseEstimator &estimator);

 private:
  PointDistances distances_;
  uint32_t map_ = 0;
  bool disagrees_ = false;
  int64_t last_ns_ = INT64_MIN;
  int64_t since_ns_ = 0;  // while it disagrees
};

}  // namespace sphc
