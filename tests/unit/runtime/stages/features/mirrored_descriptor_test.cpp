#include "runtime/stages/features/mirrored_descriptor.h"

#include <gtest/gtest.h>

#include <vector>

namespace sphc {
namespace {

std::vector<uint8_t> allBytes(const Descriptor &d) { return {d.bytes, d.bytes + kDescriptorBytes}; }

// The descriptor of a single gradient in one cell.
Descriptor single(size_t row, size_t column, size_t bin) {
  Descriptor d = {};
  d.bytes[(row * 4 + column) * 8 + bin] = 255;
  return d;
}

TEST(MirroredDescriptor, RowsAndAnglesTurnRound) {
  EXPECT_EQ(allBytes(mirrored(single(0, 1, 1))), allBytes(single(3, 1, 7)));
  EXPECT_EQ(allBytes(mirrored(single(2, 3, 0))), allBytes(single(1, 3, 0)));
}

TEST(MirroredDescriptor, TwiceItIsTheSameAgain) {
  Descriptor d;
  for (size_t i = 0; i < kDescriptorBytes; ++i) d.bytes[i] = static_cast<uint8_t>(i);
  EXPECT_NE(allBytes(mirrored(d)), allBytes(d));
  EXPECT_EQ(allBytes(mirrored(mirrored(d))), allBytes(d));
}

}  // namespace
}  // namespace sphc
