// The descriptor of a keypoint's mirror image: rows of cells and the sense of angles turn round.  What the builder
// may have done to fakes an attacker can do too, with nothing of the builder's.
#pragma once
#include <vector>

#include "runtime/types/keypoint.h"

namespace sphc::host {

inline Descriptor mirrorOf(const Descriptor &descriptor) {
  constexpr size_t kSide = 4, kBins = 8;
  Descriptor mirror;
  for (size_t i = 0; i < kDescriptorBytes; ++i) {
    const size_t row = i / (kSide * kBins), bin = i % kBins, column = i / kBins % kSide;
    mirror.bytes[i] = descriptor.bytes[((kSide - 1 - row) * kSide + column) * kBins + (kBins - bin) % kBins];
  }
  return mirror;
}

inline std::vector<Descriptor> mirrorsOf(const std::vector<Descriptor> &descriptors) {
  std::vector<Descriptor> mirrors;
  for (const Descriptor &descriptor : descriptors) mirrors.push_back(mirrorOf(descriptor));
  return mirrors;
}

}  // namespace sphc::host
