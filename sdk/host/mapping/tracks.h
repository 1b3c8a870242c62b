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

// How many sightings of tracks a frame has at least, where there are such; and of a track at most.
struct TrackBudget {
  size_t of_frame = 600;
  size_t of_frame_with_pairs = 300;  // as many too where tracks of two frames are needed for it
  size_t of_track = 60;              // an adjustment takes the square of them in time
};

// The longest tracks, until every frame has its sightings.  Of a track that has too many, evenly spread ones stay.
std::vector<Track> enoughTracks(std::vector<Track> tracks, size_t frames, const TrackBudget &budget);

}  // namespace sphc::host
