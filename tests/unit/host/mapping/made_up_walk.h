// Frames of a walk through a room of points, without images: exact but for the noise that is asked for.
#pragma once
#include <vector>

#include "host/mapping/walk.h"

namespace sphc::host {

struct MadeUpOptions {
  uint32_t frames = 40;
  double turns = 1;                // about the vertical, over the walk
  double noise = 0;                // sigmas of rays and depths
  double offset_m = 0, slope = 0;  // true depth = measured + offset + slope (measured - mid)
  uint64_t seed = 1;               // of the room
};

struct MadeUpWalk {
  Walk walk;
  std::vector<Rigid> world_from_camera;  // the truth
};

constexpr double kMadeUpMidM = 2.5;

MadeUpWalk makeWalk(const MadeUpOptions &options);
// Both walks, one after the other.
MadeUpWalk joined(MadeUpWalk first, const MadeUpWalk &second);
// b_from_a
Rigid stepOf(const MadeUpWalk &made, const FramePair &frames);
// The link of two frames as it would be without noise.
FrameLink exactLink(const MadeUpWalk &made, const FramePair &frames, uint32_t inliers);

}  // namespace sphc::host
