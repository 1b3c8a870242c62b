#include "host/publish/descriptor_symmetry.h"

namespace sphc::host {

// All gradients turn round, the keypoint's own direction with them: the patch is seen upside down.
Descriptor negative(const Descriptor &descriptor) {
  constexpr size_t kCells = 16, kBins = 8;
  Descriptor out;
  for (size_t cell = 0; cell < kCells; ++cell)
    for (size_t bin = 0; bin < kBins; ++bin)
      out.bytes[cell * kBins + bin] = descriptor.bytes[(kCells - 1 - cell) * kBins + bin];
  return out;
}

}  // namespace sphc::host
