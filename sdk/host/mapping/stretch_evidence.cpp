#include "host/mapping/stretch_evidence.h"

#include <algorithm>

#include "host/base/in_seconds.h"
#include "host/base/median.h"
#include "host/mapping/view_speed.h"

namespace sphc::host {
namespace {

constexpr uint32_t kAround = 3;  // keyframes on either side, whose speed counts

template <typename Value>
double middleOf(const Walk &walk, uint32_t first, uint32_t last, const Value &value) {
  std::vector<double> values;
  for (uint32_t i = first; i <= last; ++i) values.push_back(value(walk.keyframes[i]));
  return median(std::move(values));
}

ImageEvidence imagesOf(const Walk &walk, uint32_t first, uint32_t last) {
  ImageEvidence images;
  for (double ImageEvidence::*part : {&ImageEvidence::level, &ImageEvidence::keypoints, &ImageEvidence::with_depth,
                                      &ImageEvidence::nearer, &ImageEvidence::farther})
    images.*part = middleOf(walk, first, last, [&](const WalkFrame &frame) { return frame.evidence.*part; });
  return images;
}

// From each keyframe around that has a pose to the next that has one, across the stretch too.
double speedAround(const Walk &walk, uint32_t first, uint32_t last, const FramePoses &poses) {
  const auto count = static_cast<uint32_t>(walk.keyframes.size());
  const uint32_t begin = first > kAround ? first - kAround : 0, end = std::min(count, last + 1 + kAround);
  double fastest = 0;
  uint32_t before = end;
  for (uint32_t i = begin; i < end; ++i) {
    if (walk.keyframes[i].recording != walk.keyframes[first].recording || !poses[i]) continue;
    const int64_t time_ns = before < i ? walk.keyframes[i].time_ns - walk.keyframes[before].time_ns : 0;
    if (time_ns > 0)
      fastest = std::max(fastest,
                         viewShift(poses[before]->inverse() * *poses[i], walk.middle_depth_m) / inSeconds(time_ns));
    before = i;
  }
  return fastest;
}

double gapAround(const Walk &walk, uint32_t first, uint32_t last) {
  int64_t longest_ns = 0;
  for (uint32_t i = first; i <= last + 1 && i < walk.keyframes.size(); ++i)
    if (walk.keyframes[i].recording == walk.keyframes[first].recording)
      longest_ns = std::max(longest_ns, walk.keyframes[i].gap_ns);
  return inSeconds(longest_ns);
}

}  // namespace

StretchEvidence evidenceOf(const Walk &walk, uint32_t first, uint32_t last, const FramePoses &poses) {
  StretchEvidence evidence;
  evidence.images = imagesOf(walk, first, last);
  evidence.view_per_s = speedAround(walk, first, last, poses);
  evidence.gap_s = gapAround(walk, first, last);
  evidence.usual_gap_s = middleOf(walk, 0, static_cast<uint32_t>(walk.keyframes.size() - 1),
                                  [](const WalkFrame &frame) { return inSeconds(frame.gap_ns); });
  return evidence;
}

}  // namespace sphc::host
