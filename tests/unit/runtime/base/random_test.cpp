#include "runtime/base/random.h"

#include <gtest/gtest.h>

namespace sphc {
namespace {

TEST(Random, IsSplitMix64) {  // the first values of the reference implementation with seed 1234567
  Random random(1234567);
  EXPECT_EQ(random.next(), 6457827717110365317ull);
  EXPECT_EQ(random.next(), 3203168211198807973ull);
  EXPECT_EQ(random.next(), 9817491932198370423ull);
}

TEST(Random, BelowStaysBelowAndIsEven) {
  Random random(3);
  int count[7] = {};
  for (int i = 0; i < 70000; ++i) {
    const uint32_t value = random.below(7);
    ASSERT_LT(value, 7u);
    ++count[value];
  }
  for (int c : count) EXPECT_NEAR(c, 10000, 500);
  EXPECT_EQ(random.below(1), 0u);
}

TEST(Random, UniformIsInItsInterval) {
  Random random(4);
  double sum = 0;
  for (int i = 0; i < 100000; ++i) {
    const double u = random.uniform();
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    sum += u;
  }
  EXPECT_NEAR(sum / 100000, 0.5, 0.005);
}

}  // namespace
}  // namespace sphc
