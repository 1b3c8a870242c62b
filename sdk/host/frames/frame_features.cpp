#include "host/frames/frame_features.h"

#include <stdexcept>
#include <string>

#include "host/frames/heap_arena.h"

namespace sphc::host {
FrameFeatures::FrameFeatures(int32_t width, int32_t height, uint32_t max_keypoints, const FeatureKernels &kernels)
    : keypoints_(max_keypoints), descriptors_(max_keypoints) {
  FeatureConfig config;
  config.width = width;
  config.height = height;
  config.max_keypoints = max_keypoints;
  if (!FeatureExtractor::accepts(config))
    throw std::runtime_error(std::to_string(max_keypoints) + " keypoints of images of " + std::to_string(width) +
                             " x " + std::to_string(height) +
                             " pixels cannot be had; 16 to 8192 pixels a side and 1 to 65536 keypoints can");
  Arena state_size, scratch_size;
  FeatureExtractor::layout(config, state_size, scratch_size, nullptr);
  Arena state = heapFor(state_size, &state_), scratch = heapFor(scratch_size, &scratch_);
  FeatureExtractor::layout(config, state, scratch, &extractor_);
  extractor_.init(kernels);
}

void FrameFeatures::extract(GrayView gray) {
  count_ =
      extractor_.extract(gray, {keypoints_.data(), keypoints_.size()}, {descriptors_.data(), descriptors_.size()});
}

}  // namespace sphc::host
