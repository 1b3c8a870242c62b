// Is what a frame shows the mirror image of what the map shows?  A camera whose image is turned over, or one that
// looks into a mirror, sees the mirrored fakes of a map as they are shown.  Each patch of fakes is turned by
// itself, so a pose of such a view rests on one of them; the real points speak for the mirrored frame, all over the
// view.
#pragma once
#include "runtime/base/span.h"
#include "runtime/stages/pose/estimator.h"

namespace sphc {

// Where the inliers of a pose lie, as far as they were asked.
struct Spread {
  uint32_t inliers = 0;
  uint32_t elsewhere = 0;  // outside the spot of the sphere that has most of them
};

// Of the first of these correspondences that have depth and agree with `estimate`.
Spread spreadOf(Span<const Correspondence> correspondences, const Estimate &estimate,
                const PoseEstimator &estimator);

// Do so many of the inliers lie in one spot that the frame may be a mirror image?
bool mayBeMirrored(const Spread &spread);

enum class Handedness : uint8_t {
  kKept,
  kChanged,  // what is seen is the mirror image
  kUnclear   // the frame and its mirror image speak for poses about as clearly
};

// Of the pose that the frame has, and of the one that its mirror image has; without inliers where there is none.
Handedness handednessOf(const Spread &frame, const Spread &mirrored);

}  // namespace sphc
