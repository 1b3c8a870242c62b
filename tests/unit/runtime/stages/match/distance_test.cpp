#include "runtime/stages/match/distance.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "tests/support/random_numbers.h"

namespace sphc {
namespace {

TEST(Distance, SimdEqualsScalarOnRandomDescriptors) {
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const Descriptor a = test::randomDescriptor(&random), b = test::randomDescriptor(&random);
    ASSERT_EQ(distance2(a, b), distance2Scalar(a, b));
  }
}

TEST(Distance, Extremes) {
  Descriptor zero, full;
  std::memset(&zero, 0, sizeof zero);
  std::memset(&full, 255, sizeof full);
  EXPECT_EQ(distance2(zero, full), 128u * 255 * 255);
  EXPECT_EQ(distance2(full, zero), 128u * 255 * 255);
  EXPECT_EQ(distance2(full, full), 0u);
  for (size_t i = 0; i < kDescriptorBytes; ++i) {  // every byte counts, once
    Descriptor one = zero;
    one.bytes[i] = 3;
    EXPECT_EQ(distance2(zero, one), 9u);
  }
}

TEST(Distance, RangeSearchEqualsScalar) {
  Random random(2);
  std::vector<Descriptor> map, queries;
  for (int i = 0; i < 517; ++i) map.push_back(test::randomDescriptor(&random));
  for (int i = 0; i < 33; ++i) queries.push_back(map[random.below(517)]);
  map[300] = map[299];  // a tie: the first one wins
  queries[0] = map[299];
  const uint32_t ranges[][2] = {{0, 517}, {5, 6}, {9, 9}};
  for (const auto &range : ranges) {
    std::vector<NearestTwo> simd(33, {UINT32_MAX, UINT32_MAX, UINT32_MAX}), scalar = simd;
    searchRange({map.data(), map.size()}, range[0], range[1], {queries.data(), 33}, {simd.data(), 33});
    searchRangeScalar({map.data(), map.size()}, range[0], range[1], {queries.data(), 33}, {scalar.data(), 33});
    for (size_t q = 0; q < 33; ++q) {
      EXPECT_EQ(simd[q].best2, scalar[q].best2);
      EXPECT_EQ(simd[q].second2, scalar[q].second2);
      EXPECT_EQ(simd[q].best_index, scalar[q].best_index);
    }
  }
}

}  // namespace
}  // namespace sphc
