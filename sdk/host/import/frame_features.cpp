#include "host/import/frame_features.h"

namespace sphc::host {
namespace {

void *aligned(std::vector<uint8_t> *memory, size_t bytes) {
  memory->resize(bytes + kArenaAlignment);
  const auto address = reinterpret_cast<uintptr_t>(memory->data());
  return memory->data() + (kArenaAlignment - address % kArenaAlignment) % kArenaAlignment;
}

}  // namespace

FrameFeatures::FrameFeatures(int32_t width, int32_t height, uint32_t max_keypoints)
    : keypoints_(max_keypoints), descriptors_(max_keypoints) {
  FeatureConfig config;
  config.width = width;
  config.height = height;
  config.max_keypoints = max_keypoints;
  Arena state_size, scratch_size;
  FeatureExtractor::layout(config, state_size, scratch_size, nullptr);
  Arena state(aligned(&state_, state_size.used())), scratch(aligned(&scratch_, scratch_size.used()));
  FeatureExtractor::layout(config, state, scratch, &extractor_);
  extractor_.init();
}

void FrameFeatures::extract(GrayView gray) {
  count_ =
      extractor_.extract(gray, {keypoints_.data(), keypoints_.size()}, {descriptors_.data(), descriptors_.size()});
}

}  // namespace sphc::host
