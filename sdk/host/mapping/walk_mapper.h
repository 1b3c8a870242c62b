// From a walk to a pose for each of its frames.
#pragma once
#include <string>
#include <vector>

#include "host/mapping/adjustment.h"
#include "host/mapping/walk.h"

namespace sphc::host {

// Told what is being done, and how far; may be empty.
using MappingProgress = std::function<void(const std::string &what, uint32_t done, uint32_t total)>;

struct MappedWalk {
  FramePoses world_from_camera;  // of the keyframes; the world is the first one that has a pose
  std::vector<uint32_t> parts;   // of each keyframe, 0 for the largest; those of part 0 have poses
  size_t links = 0, loops = 0;   // between keyframes near in time, and between others
  size_t contradicting = 0;      // links that the others contradicted; left out
  AdjustmentSummary residuals;
  DepthCalibration depth;  // as learnt
};

MappedWalk mapWalk(const Walk &walk, const MappingProgress &progress);

}  // namespace sphc::host
