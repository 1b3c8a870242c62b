#include "host/mapping/stretches.h"

#include <algorithm>

namespace sphc::host {
namespace {

constexpr uint32_t kFewestOfPart = 5;  // keyframes; fewer are left out
constexpr Hints kAllHints[] = {kTooDark, kTooFast, kTooPlain, kNoDepthInRange};

uint32_t framesOf(const Walk &walk, uint32_t first, uint32_t last) {
  const auto follows = [&](const Follower &f) { return f.keyframe >= first && f.keyframe <= last; };
  return last - first + 1 +
         static_cast<uint32_t>(std::count_if(walk.followers.begin(), walk.followers.end(), follows));
}

Hints commonHints(const Walk &walk, uint32_t first, uint32_t last) {
  Hints common = 0;
  for (Hints hint : kAllHints) {
    uint32_t with = 0;
    for (uint32_t i = first; i <= last; ++i) with += (walk.keyframes[i].hints & hint) != 0;
    if (2 * with >= last - first + 1) common |= hint;
  }
  return common;
}

}  // namespace

std::vector<Stretch> runsOf(const Walk &walk, const std::vector<uint32_t> &labels, uint32_t label,
                            const FramePoses &poses) {
  std::vector<Stretch> runs;
  for (uint32_t i = 0; i < labels.size(); ++i) {
    if (labels[i] != label) continue;
    const bool follows = !runs.empty() && runs.back().last + 1 == i &&
                         walk.keyframes[i - 1].recording == walk.keyframes[i].recording;
    if (!follows) runs.push_back({i, i, 0, 0, {}});
    runs.back().last = i;
  }
  for (Stretch &run : runs) {
    run.frames = framesOf(walk, run.first, run.last);
    run.hints = commonHints(walk, run.first, run.last);
    run.evidence = evidenceOf(walk, run.first, run.last, poses);
  }
  return runs;
}

Stretches stretchesOf(const Walk &walk, const std::vector<uint32_t> &parts, const FramePoses &poses) {
  const uint32_t count = parts.empty() ? 0 : *std::max_element(parts.begin(), parts.end()) + 1;
  std::vector<uint32_t> size(count), labels(parts);
  for (uint32_t part : parts) ++size[part];
  for (uint32_t &label : labels)
    if (label > 0 && size[label] < kFewestOfPart) label = count;
  Stretches stretches;
  stretches.mapped = runsOf(walk, labels, 0, poses);
  for (uint32_t part = 1; part < count; ++part)
    if (size[part] >= kFewestOfPart) stretches.apart.push_back(runsOf(walk, labels, part, poses));
  stretches.left_out = runsOf(walk, labels, count, poses);
  return stretches;
}

}  // namespace sphc::host
