// Which frames of a walk are worth comparing.
#pragma once
#include <algorithm>
#include <optional>
#include <set>
#include <vector>

#include "host/mapping/frame_links.h"

namespace sphc::host {

// Frames further apart in the list are a loop.
constexpr uint32_t kMostGapInTime = 17;

// Poses of frames, world_from_camera; none of those that are not connected.
using FramePoses = std::vector<std::optional<Rigid>>;
inline size_t placedCount(const FramePoses &poses) {
  return static_cast<size_t>(
      std::count_if(poses.begin(), poses.end(), [](const auto &pose) { return pose.has_value(); }));
}

// Of two recordings, or far apart in one.
bool isLoop(const std::vector<WalkFrame> &frames, const FramePair &pair);
// Each frame and those 1 to 17 before it in its recording, in growing steps.
std::vector<FramePair> pairsInTime(const std::vector<WalkFrame> &frames);
// Loops: frames that have many rare words in common.  Words are cells of the descriptors (Sivic and Zisserman
// 2003).  As many of its own recording as of all others.
std::vector<FramePair> pairsByLook(const std::vector<WalkFrame> &frames);
// Frames that see the same surfaces by these poses, but for those that were tried.
std::vector<FramePair> pairsByOverlap(const std::vector<WalkFrame> &frames, const FramePoses &world_from_camera,
                                      const std::set<FramePair> &tried);

}  // namespace sphc::host
