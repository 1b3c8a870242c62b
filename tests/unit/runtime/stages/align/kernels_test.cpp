#include "runtime/stages/align/kernels.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "tests/support/random_numbers.h"

namespace sphc {
namespace {

// The scalar and the SIMD dense kernels are compared as a whole, in dense_test.cpp.
TEST(AlignKernels, PatchSumsOfBothVersions) {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    uint16_t raw[kFitSide][kFitLanes];
    for (auto &row : raw)
      for (uint16_t &mm : row)
        mm = static_cast<uint16_t>(random.below(4) == 0 ? random.below(65536) : 1500 + random.below(80));
    PatchView patch = {};
    for (int r = 0; r < kFitSide; ++r) patch.rows[r] = raw[r];
    patch.low = 250, patch.high = 6000, patch.anchor = 1540;
    patch.dx = 0.01f * static_cast<float>(random.below(100)) - 0.5f;
    patch.dy = 0.01f * static_cast<float>(random.below(100)) - 0.5f;
    PatchSums simd, scalar;
    simdAlignKernels().patch_sums(patch, &simd);
    scalarAlignKernels().patch_sums(patch, &scalar);
    EXPECT_EQ(std::memcmp(&simd, &scalar, sizeof simd), 0);
    EXPECT_GT(simd.n, 0);
  }
}

TEST(AlignKernels, NearestRowOfBothVersions) {
  Random random(2);
  for (int count : {1, 7, 16, 33, 100}) {
    std::vector<uint16_t> raw(static_cast<size_t>(count)), simd(raw.size(), 60000);
    for (uint16_t &mm : raw) mm = static_cast<uint16_t>(random.below(65536));
    std::vector<uint16_t> scalar = simd;
    simdAlignKernels().nearest_row(raw.data(), 250, count, simd.data());
    scalarAlignKernels().nearest_row(raw.data(), 250, count, scalar.data());
    EXPECT_EQ(simd, scalar);
    for (size_t i = 0; i < raw.size(); ++i) {
      const uint16_t from_first = static_cast<uint16_t>(raw[i] - 250);  // what is nearer wraps around
      EXPECT_EQ(simd[i], from_first < 60000 ? from_first : 60000);
    }
  }
}

}  // namespace
}  // namespace sphc
