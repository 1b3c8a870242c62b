// The two cameras of a HoloLens as one rig.
#pragma once

#include "host/recording/pose_track.h"

namespace sphc::recording {

// Its recordings tell where both cameras were in the world, at different times, and not where one is on the other:
// color_from_depth is the median over all times of depth at which both are known.  Depth is in millimetres.  Throws
// Failure (ARGUMENT) without a name where there is no such time.
sphc_rig rigOfHoloLens(const sphc_camera &color, const sphc_camera &depth, const PoseTrack &world_from_color,
                       const PoseTrack &world_from_rig, const sphc_rigid &depth_from_rig);

}  // namespace sphc::recording
