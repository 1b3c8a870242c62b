// What the feature stage finds.
#pragma once
#include <cstddef>
#include <cstdint>

namespace sphc {

struct Keypoint {
  float x_px, y_px;       // centre of the top-left pixel is (0.5, 0.5)
  float scale_px;         // standard deviation of the Gaussian at which it was found
  float orientation_rad;  // of the dominant gradient, image axes (x right, y down)
  float response;         // |difference of Gaussians| at the refined extremum, grey levels in [0, 1]
};

constexpr size_t kDescriptorBytes = 128;
// RootSIFT: square roots of the L1-normalised histogram, times 512, at most 255.
struct Descriptor {
  uint8_t bytes[kDescriptorBytes];
};
static_assert(sizeof(Descriptor) == kDescriptorBytes);

}  // namespace sphc
