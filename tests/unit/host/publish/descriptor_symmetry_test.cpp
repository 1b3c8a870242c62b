#include "host/publish/descriptor_symmetry.h"

#include <gtest/gtest.h>

#include <vector>

namespace sphc::host {
namespace {

std::vector<uint8_t> allBytes(const Descriptor &d) { return {d.bytes, d.bytes + kDescriptorBytes}; }

// The descriptor of a single gradient in one cell.
Descriptor single(size_t row, size_t column, size_t bin) {
  Descriptor d = {};
  d.bytes[(row * 4 + column) * 8 + bin] = 255;
  return d;
}

TEST(DescriptorSymmetry, ANegativeIsSeenUpsideDown) {
  EXPECT_EQ(allBytes(negative(single(0, 1, 5))), allBytes(single(3, 2, 5)));
}

}  // namespace
}  // namespace sphc::host
