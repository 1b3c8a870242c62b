// The second pose of a planar scene.  From the sphere centre a plane looks nearly alike when its tilt is mirrored
// at the line of sight (Oberkampf, DeMenthon and Davis, "Iterative pose estimation using coplanar feature points",
// CVIU 1996): two minima of the cost, and the wrong one can have most of the inliers of the right one.
#pragma once
#include "runtime/base/span.h"
#include "runtime/geometry/rigid.h"
#include "runtime/types/correspondence.h"

namespace sphc {

// Writes the mirrored pose; false where those of the correspondences that agree with `camera_from_map` (squared
// whitened residual below `threshold2`) are not planar, or look at the plane so squarely that there is but one
// pose.
bool mirroredPose(Span<const Correspondence> correspondences, const Rigid &camera_from_map, double threshold2,
                  Rigid *mirrored);

}  // namespace sphc
