// Links of many pairs of frames, by several threads.
#pragma once
#include <deque>
#include <vector>

#include "host/mapping/frame_links.h"
#include "host/mapping/likely_pairs.h"

namespace sphc::host {

class PairLinker {
 public:
  // `threads`: at most so many; 0: one for each core.
  PairLinker(uint32_t max_keypoints, uint32_t threads);

  // Of each pair what FrameLinker says, whatever the number of threads.  `expected`: poses of the frames, and so
  // where their links are looked for; null: anywhere.
  std::vector<std::optional<FrameLink>> link(const std::vector<WalkFrame> &frames,
                                             const std::vector<FramePair> &pairs, const LinkDemands &demands,
                                             const FramePoses *expected);

  // As many pairs as keep all threads busy, and take a moment.
  size_t batch() const { return 16 * linkers_.size(); }

 private:
  std::deque<FrameLinker> linkers_;  // of each thread; they stay where they are
};

}  // namespace sphc::host
