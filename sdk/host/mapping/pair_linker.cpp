#include "host/mapping/pair_linker.h"

#include <algorithm>
#include <atomic>
#include <future>
#include <thread>

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
  const auto work = [&](FrameLinker *linker) {
    for (size_t i = next++; i < pairs.size(); i = next++) {
      const FramePair &pair = pairs[i];
      Rigid b_from_a;
      if (expected) b_from_a = (*expected)[pair.b]->inverse() * *(*expected)[pair.a];
      links[i] = linker->link(frames, pair, demands, expected ? &b_from_a : nullptr);
    }
  };
  std::vector<std::future<void>> others;
  for (size_t i = 1; i < linkers_.size(); ++i) others.push_back(std::async(std::launch::async, work, &linkers_[i]));
  work(&linkers_[0]);
  for (std::future<void> &other : others) other.get();
  return links;
}

}  // namespace sphc::host
