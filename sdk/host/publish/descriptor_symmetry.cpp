#include "host/publish/descriptor_symmetry.h"

namespace sphc::host {
namespace {

constexpr size_t kCells = 4, kBins = 8;

size_t byteAt(size_t row, size_t column, size_t bin) { return (row * kCells + column) * kBins + bin; }

// A descriptor whose byte (row, column, bin) is the byte that `source` names.
template <typename Source>
Descriptor permuted(const Descriptor &descriptor, Source source) {
  Descriptor out;
  for (size_t row = 0; row < kCells; ++row)
    for (size_t column = 0; column < kCells; ++column)
      for (size_t bin = 0; bin < kBins; ++bin)
        out.bytes[byteAt(row, column, bin)] = descriptor.bytes[source(row, column, bin)];
  return out;
}

}  // namespace

Descriptor mirrored(const Descriptor &descriptor) {
  return permuted(descriptor, [](size_t row, size_t column, size_t bin) {
    return byteAt(kCells - 1 - row, column, (kBins - bin) % kBins);
  });
}

// All gradients turn round, the keypoint's own direction with them: the patch is seen upside down.
Descriptor negative(const Descriptor &descriptor) {
  return permuted(descriptor, [](size_t row, size_t column, size_t bin) {
    return byteAt(kCells - 1 - row, kCells - 1 - column, bin);
  });
}

}  // namespace sphc::host
