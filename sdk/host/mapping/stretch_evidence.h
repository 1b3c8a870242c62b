// What was measured of the frames of a stretch and of those around it: why it may have found no place.
#pragma once
#include "host/mapping/pose_beliefs.h"
#include "host/mapping/walk.h"

namespace sphc::host {

struct StretchEvidence {
  ImageEvidence images;    // medians over the keyframes
  double view_per_s = 0;   // how fast the view moved around it at most, as rays; 0: nothing near it has a pose
  double gap_s = 0;        // the longest time without a frame in it, before it and after it
  double usual_gap_s = 0;  // between frames of the walk, median
};

// Of keyframes `first` to `last`, both among them; `poses`: of all keyframes, none of those without a place.
StretchEvidence evidenceOf(const Walk &walk, uint32_t first, uint32_t last, const FramePoses &poses);

}  // namespace sphc::host
