#include "runtime/stages/features/radix_sort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "runtime/base/random.h"

namespace sphc {
namespace {

TEST(RadixSort, IsAStableSort) {
  Random random(1);
  for (const uint32_t count : {0u, 1u, 2u, 255u, 3000u}) {
    for (const uint32_t range : {5u, 70000u, 0xFFFFFFFFu}) {
      std::vector<SortKey> values(count), spare(count);
      for (uint32_t i = 0; i < count; ++i) values[i] = {random.below(range), i};
      std::vector<SortKey> expected = values;
      std::stable_sort(expected.begin(), expected.end(),
                       [](const SortKey &a, const SortKey &b) { return a.key < b.key; });
      radixSort(values.data(), spare.data(), count);
      for (uint32_t i = 0; i < count; ++i) {
        ASSERT_EQ(values[i].key, expected[i].key);
        ASSERT_EQ(values[i].index, expected[i].index);
      }
    }
  }
}

TEST(RadixSort, KeysOrderAsTheirValues) {
  const float values[] = {0.0f, 1e-40f, 1e-20f, 0.5f, 0.50001f, 1.0f, 3e38f};
  for (size_t i = 1; i < std::size(values); ++i) EXPECT_LT(keyOf(values[i - 1]), keyOf(values[i]));
}

}  // namespace
}  // namespace sphc
