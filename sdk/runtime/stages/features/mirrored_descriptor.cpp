#include "runtime/stages/features/mirrored_descriptor.h"

namespace sphc {
namespace {

// 4 x 4 cells of 8 angles relative to the keypoint's own: descriptor-inl.h.
constexpr size_t kCells = 4, kBins = 8, kRowBytes = kCells * kBins;

}  // namespace

// Gradients along the keypoint's own direction stay; across it they change sign.
Descriptor mirrored(const Descriptor &descriptor) {
  Descriptor mirror;
  for (size_t i = 0; i < kDescriptorBytes; ++i) {
    const size_t row = i / kRowBytes, column = i / kBins % kCells, bin = i % kBins;
    mirror.bytes[i] = descriptor.bytes[(kCells - 1 - row) * kRowBytes + column * kBins + (kBins - bin) % kBins];
  }
  return mirror;
}

}  // namespace sphc
