// Poses that agree with links between frames: first along the surest links, then all together (Grisetti, Kuemmerle,
// Stachniss, Burgard, "A tutorial on graph-based SLAM", 2010).
#pragma once
#include <vector>

#include "host/mapping/frame_links.h"
#include "host/mapping/likely_pairs.h"
#include "host/mapping/pose_beliefs.h"

namespace sphc::host {

// Which frames links connect: a label for each, 0 for the largest part, then in order of size.
std::vector<uint32_t> connectedParts(size_t frames, const std::vector<FramePair> &pairs);
std::vector<uint32_t> connectedParts(size_t frames, const std::vector<FrameLink> &links);

// Removes loops that alone connect stretches of the walk: one that is wrong would be contradicted by nothing. Three
// of the same two stretches, or one with many inliers, are believed.  Returns how many were removed.
size_t dropWeakBridges(size_t frames, std::vector<FrameLink> *links);

// Poses of the frames of part 0 along the links with most inliers, then along the steps that are believed.  They
// begin at the anchors; where there is none, the world is the first of these frames.
FramePoses posesAlongLinks(const std::vector<FrameLink> &links, const std::vector<uint32_t> &parts,
                           const PoseBeliefs &beliefs);

// Moves the poses until they agree with links and beliefs as well as they can; contradicting ones lose their say
// (Cauchy's loss).  Without anchors the first frame that has a pose stays.
void adjustToLinks(const std::vector<FrameLink> &links, const PoseBeliefs &beliefs, FramePoses *world_from_camera);

// Do the poses agree with the link, to within what a loop may be off?
bool isConsistent(const FrameLink &link, const FramePoses &world_from_camera);

}  // namespace sphc::host
