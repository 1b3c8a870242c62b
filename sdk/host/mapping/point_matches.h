// Keypoints of two frames that look alike.
#pragma once
#include <vector>

#include "host/mapping/walk_frame.h"
#include "runtime/geometry/rigid.h"

namespace sphc::host {

// A keypoint of one frame and the one of another that shows the same.
struct PointMatch {
  uint32_t a, b;
};

// Nearest to each other both ways, and clearly nearer than the runner-up (Lowe 2004), among all keypoints.
std::vector<PointMatch> matchAll(const WalkFrame &a, const WalkFrame &b);
// The same among the keypoints of b near where the pose expects those of a that have depth.
std::vector<PointMatch> matchNear(const WalkFrame &a, const WalkFrame &b, const Rigid &b_from_a);

}  // namespace sphc::host
