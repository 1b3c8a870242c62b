#include "host/mapping/pair_linker.h"

#include <algorithm>
#include <atomic>
#include <thread>

#include "host/base/on_threads.h"

namespace sphc::host {

PairLinker::PairLinker(uint32_t max_keypoints, uint32_t threads) {
  if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());
  for (uint32_t i = 0; i < threads; ++i) linkers_.emplace_back(max_keypoints);
}

std::vector<std::optional<FrameLink>> PairLinker::link(const std::vector<WalkFrame> &frames,
                                                       const std::vector<FramePair> &pairs,
                                                       const LinkDemands &demands, const FramePoses *expected) {
  std::vector<std::optional<FrameLink>> links(pairs.size());
  std::atomic<size_t> next{0};
  onThreads(linkers_.size(), [&](size_t thread) {
    for (size_t i = next++; i < pairs.size(); i = next++) {
      const FramePair &pair = pairs[i];
      Rigid b_from_a;
      if (expected) b_from_a = (*expected)[pair.b]->inverse() * *(*expected)[pair.a];
      links[i] = linkers_[thread].link(frames, pair, demands, expected ? &b_from_a : nullptr);
    }
  });
  return links;
}

}  // namespace sphc::host
