// The device's feature stage in memory from the workstation's heap.
#pragma once
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "runtime/stages/features/extractor.h"

namespace sphc::host {

class HeapExtractor {
 public:
  static constexpr uint32_t kMaxKeypoints = 1200;  // as a mapping frame has

  HeapExtractor(int32_t width, int32_t height) : keypoints_(kMaxKeypoints), descriptors_(kMaxKeypoints) {
    FeatureConfig config;
    config.width = width;
    config.height = height;
    config.max_keypoints = kMaxKeypoints;
    if (!FeatureExtractor::accepts(config))
      throw std::runtime_error("an image of " + std::to_string(width) + " x " + std::to_string(height) +
                               " pixels is too small or too large");
    Arena state_size, scratch_size;
    FeatureExtractor::layout(config, state_size, scratch_size, nullptr);
    memory_.resize(state_size.used() + scratch_size.used() + kArenaAlignment);
    const auto address = reinterpret_cast<uintptr_t>(memory_.data());
    uint8_t *begin = memory_.data() + (kArenaAlignment - address % kArenaAlignment) % kArenaAlignment;
    Arena state(begin), scratch(begin + state_size.used());
    FeatureExtractor::layout(config, state, scratch, &extractor_);
    extractor_.init();
  }

  // How many were found; they are in keypoints() and descriptors() until the next call.
  uint32_t extract(const GrayView &image) {
    return extractor_.extract(image, {keypoints_.data(), keypoints_.size()},
                              {descriptors_.data(), descriptors_.size()});
  }
  const std::vector<Keypoint> &keypoints() const { return keypoints_; }
  const std::vector<Descriptor> &descriptors() const { return descriptors_; }

 private:
  std::vector<uint8_t> memory_;
  FeatureExtractor extractor_;
  std::vector<Keypoint> keypoints_;
  std::vector<Descriptor> descriptors_;
};

}  // namespace sphc::host
