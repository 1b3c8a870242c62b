#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "host/frames/frame_features.h"
#include "lab/common/interleave.h"
#include "lab/features/variant.h"

namespace sphc::host {
namespace {

FoundFeatures find(const GrayView &image, FrameFeatures *features) {
  FoundFeatures found;
  const double begin = threadCpuSeconds();
  features->extract(image);
  found.seconds = threadCpuSeconds() - begin;
  for (uint32_t i = 0; i < features->count(); ++i) {
    found.pixels_px.push_back(features->pixel(i));
    const uint8_t *bytes = features->descriptor(i).bytes;
    found.descriptors.insert(found.descriptors.end(), bytes, bytes + kDescriptorBytes);
  }
  return found;
}

FeaturesVariant variant(const std::string &name, int32_t width, int32_t height, uint32_t keypoints,
                        const FeatureKernels &kernels) {
  try {
    const auto features = std::make_shared<FrameFeatures>(width, height, keypoints, kernels);
    return {name, kDescriptorBytes, false,
            [features](const GrayView &image) { return find(image, features.get()); }, ""};
  } catch (const std::runtime_error &refusal) {
    return {name, kDescriptorBytes, false, nullptr, refusal.what()};
  }
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
