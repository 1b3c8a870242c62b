// The device's own feature stage, in memory from the workstation's heap.
#pragma once
#include <vector>

#include "runtime/geometry/rotation.h"
#include "runtime/stages/features/extractor.h"

namespace sphc::host {

class FrameFeatures {
 public:
  // Throws std::runtime_error where the stage takes no such images.
  FrameFeatures(int32_t width, int32_t height, uint32_t max_keypoints,
                const FeatureKernels &kernels = simdFeatureKernels());

  // Of an image of that size; what was found stays until the next call.
  void extract(GrayView gray);
  uint32_t count() const { return count_; }
  const Keypoint &keypoint(uint32_t i) const { return keypoints_[i]; }
  const Descriptor &descriptor(uint32_t i) const { return descriptors_[i]; }
  Vector2 pixel(uint32_t i) const {
    return {static_cast<double>(keypoints_[i].x_px), static_cast<double>(keypoints_[i].y_px)};
  }

 private:
  std::vector<uint8_t> state_, scratch_;
  FeatureExtractor extractor_;
  std::vector<Keypoint> keypoints_;
  std::vector<Descriptor> descriptors_;
  uint32_t count_ = 0;
};

}  // namespace sphc::host
