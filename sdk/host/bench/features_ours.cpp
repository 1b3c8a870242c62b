#include <algorithm>
#include <cmath>
#include <memory>

#include "host/bench/features_variant.h"
#include "host/bench/interleave.h"
#include "runtime/stages/features/extractor.h"

namespace sphc::host {
namespace {

// An extractor in memory from the workstation's heap.
class Owned {
 public:
  Owned(const FeatureConfig &config, const FeatureKernels &kernels)
      : keypoints_(config.max_keypoints), descriptors_(config.max_keypoints) {
    Arena state_size, scratch_size;
    FeatureExtractor::layout(config, state_size, scratch_size, nullptr);
    memory_.resize(state_size.used() + scratch_size.used() + kArenaAlignment);
    const auto address = reinterpret_cast<uintptr_t>(memory_.data());
    uint8_t *begin = memory_.data() + (kArenaAlignment - address % kArenaAlignment) % kArenaAlignment;
    Arena state(begin), scratch(begin + state_size.used());
    FeatureExtractor::layout(config, state, scratch, &extractor_);
    extractor_.init(kernels);
  }

  FoundFeatures run(const GrayView &image) {
    FoundFeatures found;
    const double begin = threadCpuSeconds();
    const uint32_t count = extractor_.extract(image, {keypoints_.data(), keypoints_.size()},
                                              {descriptors_.data(), descriptors_.size()});
    found.seconds = threadCpuSeconds() - begin;
    for (uint32_t i = 0; i < count; ++i) {
      found.pixels_px.emplace_back(static_cast<double>(keypoints_[i].x_px),
                                   static_cast<double>(keypoints_[i].y_px));
    }
    const uint8_t *bytes = descriptors_[0].bytes;
    found.descriptors.assign(bytes, bytes + count * kDescriptorBytes);
    return found;
  }

 private:
  std::vector<uint8_t> memory_;
  std::vector<Keypoint> keypoints_;
  std::vector<Descriptor> descriptors_;
  FeatureExtractor extractor_;
};

FeaturesVariant variant(const std::string &name, int32_t width, int32_t height, uint32_t keypoints,
                        const FeatureKernels &kernels) {
  FeatureConfig config;
  config.width = width;
  config.height = height;
  config.max_keypoints = keypoints;
  if (!FeatureExtractor::accepts(config))
    return {name, kDescriptorBytes, false, nullptr, "images of 16 to 8192 pixels a side are needed"};
  const auto owned = std::make_shared<Owned>(config, kernels);
  return {name, kDescriptorBytes, false, [owned](const GrayView &image) { return owned->run(image); }, ""};
}

}  // namespace

std::vector<FeaturesVariant> ourFeatures(int32_t width, int32_t height) {
  return {variant("ours 800", width, height, 800, simdFeatureKernels()),
          variant("ours 1000", width, height, 1000, simdFeatureKernels()),
          variant("ours 800, scalar", width, height, 800, scalarFeatureKernels())};
}

void appendRootSift(const float *histogram, std::vector<uint8_t> *descriptors) {
  double sum = 0;
  for (size_t i = 0; i < kDescriptorBytes; ++i) sum += static_cast<double>(histogram[i]);
  for (size_t i = 0; i < kDescriptorBytes; ++i) {
    const double share = sum > 0 ? static_cast<double>(histogram[i]) / sum : 0.0;
    descriptors->push_back(static_cast<uint8_t>(std::min(255.0, std::floor(512 * std::sqrt(share) + 0.5))));
  }
}

}  // namespace sphc::host
