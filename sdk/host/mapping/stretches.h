// Stretches of a walk that found no place in its map.
#pragma once
#include <vector>

#include "host/mapping/stretch_evidence.h"

namespace sphc::host {

// Keyframes of a recording that follow each other, `first` and `last` among them.
struct Stretch {
  uint32_t first = 0, last = 0;
  uint32_t frames = 0;  // followers too
  Hints hints = 0;      // that at least half of the keyframes have
  StretchEvidence evidence;
};

struct Stretches {
  std::vector<Stretch> mapped;
  // Of each part that is connected in itself, but never met the largest.
  std::vector<std::vector<Stretch>> apart;
  std::vector<Stretch> left_out;  // connected with nothing, or with next to nothing
};

// Of keyframes with this label, in order; `labels`: one for each keyframe, `poses`: theirs.
std::vector<Stretch> runsOf(const Walk &walk, const std::vector<uint32_t> &labels, uint32_t label,
                            const FramePoses &poses);

// `parts`: a label for each keyframe, 0 for those of the map; `poses`: theirs.
Stretches stretchesOf(const Walk &walk, const std::vector<uint32_t> &parts, const FramePoses &poses);

}  // namespace sphc::host
