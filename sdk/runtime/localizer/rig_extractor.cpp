#include "runtime/localizer/rig_extractor.h"

#include <algorithm>

#include "runtime/stages/features/gray.h"

namespace sphc {
namespace {

// Large enough for the images of all cameras.
FeatureConfig featureConfigOf(const LocalizerConfig &config) {
  FeatureConfig features;
  features.width = config.color_camera.width();
  features.height = config.color_camera.height();
  for (const RigCamera &further : config.further) {
    features.width = std::max(features.width, further.camera.width());
    features.height = std::max(features.height, further.camera.height());
  }
  features.max_keypoints = config.max_keypoints;
  features.pieces = config.parallel.pieces;
  return features;
}

size_t mostPixelsOfFurther(const LocalizerConfig &config) {
  size_t most = 0;
  for (const RigCamera &further : config.further)
    most = std::max(most, size_t(further.camera.width()) * size_t(further.camera.height()));
  return most;
}

// Along the cycle that `start` is in, element i becomes the one that was order[i]-th.
template <typename T>
void permuteCycle(Span<T> items, const Span<uint32_t> &order, uint32_t start) {
  const T first = items[start];
  uint32_t at = start;
  for (uint32_t from = order[at]; from != start; from = order[at]) {
    items[at] = items[from];
    at = from;
  }
  items[at] = first;
}

}  // namespace

void FeatureRoom::layout(const char *const names[3], const LocalizerConfig &config, Arena &arena,
                         FeatureRoom *room) {
  const uint32_t n = config.max_keypoints;
  FeatureRoom discarded;  // receives empty spans while measuring
  FeatureRoom &r = room ? *room : discarded;
  r.keypoints = arena.take<Keypoint>(names[0], n);
  r.descriptors = arena.take<Descriptor>(names[1], n);
  if (config.further.size() > 0) r.camera_of = arena.take<uint8_t>(names[2], n);
}

void RigExtractor::layout(const LocalizerConfig &config, Arena &state, Arena &scratch, RigExtractor *extractor) {
  RigExtractor discarded;
  RigExtractor &e = extractor ? *extractor : discarded;
  FeatureExtractor::layout(featureConfigOf(config), state, scratch, extractor ? &e.extractor_ : nullptr);
  if (config.further.size() == 0) return;
  e.gray_ = scratch.take<uint8_t>("localizer.further_gray", mostPixelsOfFurther(config));
  e.order_ = scratch.take<uint32_t>("localizer.order", config.max_keypoints);
}

uint32_t RigExtractor::extract(GrayView color, const FurtherViews &further, const FeatureRoom &room,
                               const Deadline &deadline) {
  cut_ = false;
  uint32_t begins[kMostCameras + 1] = {};
  const auto cameras = static_cast<uint32_t>(1 + further.size());
  for (uint32_t camera = 0; camera < cameras; ++camera) {
    const uint32_t begin = begins[camera], left = static_cast<uint32_t>(room.keypoints.size()) - begin;
    begins[camera + 1] = begin;
    if (camera > 0 && !further[camera - 1].image.bytes.data) continue;
    const uint32_t share = left / (cameras - camera);
    const GrayView gray = camera == 0 ? color : grayOf(further[camera - 1].image, gray_);
    const Deadline own = camera + 1 == cameras ? deadline : deadline.afterShare(1.0 / (cameras - camera));
    const uint32_t count = extractor_.extract(gray, {room.keypoints.data() + begin, share},
                                              {room.descriptors.data() + begin, share}, own);
    cut_ = cut_ || extractor_.wasCut();
    if (!room.camera_of.empty()) std::fill_n(room.camera_of.begin() + begin, count, static_cast<uint8_t>(camera));
    begins[camera + 1] += count;
  }
  if (cameras > 1) sortByResponse(begins, cameras, room);
  return begins[cameras];
}

// Merges what is sorted for each camera; of equal ones that of the first camera comes first.
void RigExtractor::sortByResponse(const uint32_t *begins, uint32_t cameras, const FeatureRoom &room) {
  uint32_t next[kMostCameras];
  std::copy_n(begins, cameras, next);
  for (uint32_t i = 0; i < begins[cameras]; ++i) {
    uint32_t best = cameras;
    for (uint32_t c = 0; c < cameras; ++c) {
      if (next[c] == begins[c + 1]) continue;
      if (best == cameras || room.keypoints[next[c]].response > room.keypoints[next[best]].response) best = c;
    }
    order_[i] = next[best]++;
  }
  for (uint32_t i = 0; i < begins[cameras]; ++i) {
    permuteCycle(room.keypoints, order_, i);
    permuteCycle(room.descriptors, order_, i);
    permuteCycle(room.camera_of, order_, i);
    for (uint32_t at = i; order_[at] != at;) {  // not once more
      const uint32_t from = order_[at];
      order_[at] = at;
      at = from;
    }
  }
}

}  // namespace sphc
