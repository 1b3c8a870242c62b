// span.h and fixed_vector.h.
#include <gtest/gtest.h>

#include "runtime/base/fixed_vector.h"
#include "runtime/base/span.h"

namespace sphc {
namespace {

TEST(Span, BorrowsAndConvertsToConst) {
  int values[] = {1, 2, 3, 4};
  const Span<int> span(values, 4);
  const Span<const int> constant = span;
  span[2] = 30;
  EXPECT_EQ(constant[2], 30);
  EXPECT_EQ(constant.first(2).size(), 2u);
  EXPECT_EQ(constant.end() - constant.begin(), 4);
  EXPECT_TRUE(Span<int>().empty());
  int sum = 0;
  for (int v : constant) sum += v;
  EXPECT_EQ(sum, 37);
}

TEST(FixedVector, FillsToItsCapacity) {
  FixedVector<int, 3> list;
  EXPECT_EQ(list.size(), 0u);
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(list.full());
    list.push(i * i);
  }
  EXPECT_TRUE(list.full());
  EXPECT_EQ(list[2], 4);
  EXPECT_EQ(list.end() - list.begin(), 3);
  list.clear();
  EXPECT_EQ(list.size(), 0u);
}

}  // namespace
}  // namespace sphc
