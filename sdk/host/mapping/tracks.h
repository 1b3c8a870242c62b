// Points of the world that several frames see: matches of links, joined.
#pragma once
#include <vector>

#include "host/mapping/frame_links.h"
#include "host/mapping/likely_pairs.h"

namespace sphc::host {

// A keypoint of a frame.
struct Sighting {
  uint32_t frame, point;
};

// At most one of a frame, in order of frames.
using Track = std::vector<Sighting>;

// Joins matches, those of the surest links first.  A match that would put two keypoints of one frame into a track
// is wrong and left out.  Two frames make a track: a frame may share most of what it sees with one other alone.
std::vector<Track> tracksOf(const std::vector<WalkFrame> &frames, const std::vector<FrameLink> &links);

// The longest tracks, as many as give every frame that many sightings where there are such.  Of a track that has
// more than `longest` sightings so many stay, evenly spread: an adjustment takes the square of them in time.
std::vector<Track> enoughTracks(std::vector<Track> tracks, size_t frames, size_t wanted, size_t longest);

}  // namespace sphc::host
