// How two frames of a walk lie to each other.  Each is in turn a small sphere cloud for the other: the bearings of
// its keypoints are directions from its own centre, and the other's lifted keypoints are localized among them.
#pragma once
#include <optional>
#include <vector>

#include "host/mapping/point_matches.h"
#include "runtime/stages/pose/estimator.h"

namespace sphc::host {

// Places of two frames in a list of frames; a is the earlier.
struct FramePair {
  uint32_t a, b;
  bool operator<(const FramePair &other) const { return a != other.a ? a < other.a : b < other.b; }
  uint32_t gap() const { return b - a; }
};

struct FrameLink {
  FramePair frames;
  Rigid b_from_a;
  Matrix6 covariance = Matrix6::Zero();  // of (rotation rad, translation m), frame b, T = exp(xi) b_from_a
  uint32_t inliers = 0;                  // the fewer of the two directions
  bool is_loop = false;                  // of two recordings, or far apart in one
  std::vector<PointMatch> matches;       // that agree with it
};

// Of a motion that should be none: is it so small?
inline bool isWithin(const Rigid &error, double limit_m, double limit_rad) {
  return error.translation_m.norm() <= limit_m && rotationAngle(error.rotation) <= limit_rad;
}

// What a link must show.
struct LinkDemands {
  uint32_t min_inliers = 20;
  double min_share = 0.25;  // of the matches with depth
};

class FrameLinker {
 public:
  explicit FrameLinker(uint32_t max_keypoints);

  // None where the two do not agree on one pose, seen from either side.  `expected`: where the pose is looked for;
  // null: anywhere.
  std::optional<FrameLink> link(const std::vector<WalkFrame> &frames, const FramePair &pair,
                                const LinkDemands &demands, const Rigid *expected_b_from_a = nullptr);

 private:
  // Of the frame that `points` are of, against the bearings of the other.
  struct Side {
    std::vector<Correspondence> correspondences;
    Estimate estimate;
  };
  void localize(const Rigid *expected, Side *side);
  bool isSupported(const Side &side, const LinkDemands &demands) const;

  PoseEstimator estimator_;
  std::vector<uint8_t> memory_;
};

}  // namespace sphc::host
