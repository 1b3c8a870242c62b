#include "lab/common/interleave.h"

#include <gtest/gtest.h>

#include <set>

namespace sphc::host {
namespace {

TEST(Interleave, GivesMediansAndRunsSlowVariantsOnce) {
  Random random(1);
  std::vector<std::vector<uint32_t>> repeats(3);
  const auto seconds = interleave(3, 5, &random, [&](size_t variant, uint32_t repeat) {
    repeats[variant].push_back(repeat);
    return variant == 2 ? 0.2 : 0.001 * static_cast<double>(variant + 1 + 10 * (repeat == 3));
  });
  EXPECT_EQ(repeats[0], (std::vector<uint32_t>{0, 1, 2, 3, 4}));
  EXPECT_EQ(repeats[2], (std::vector<uint32_t>{0}));
  EXPECT_DOUBLE_EQ(seconds[0], 0.001);
  EXPECT_DOUBLE_EQ(seconds[1], 0.002);
  EXPECT_DOUBLE_EQ(seconds[2], 0.2);
}

TEST(Interleave, OrdersDiffer) {
  Random random(1);
  std::vector<size_t> order;
  interleave(4, 20, &random, [&](size_t variant, uint32_t) {
    order.push_back(variant);
    return 0.0;
  });
  ASSERT_EQ(order.size(), 80u);
  std::set<std::vector<size_t>> orders;
  for (size_t i = 0; i < order.size(); i += 4)
    orders.insert({order.begin() + static_cast<long>(i), order.begin() + static_cast<long>(i) + 4});
  EXPECT_GT(orders.size(), 5u);
}

}  // namespace
}  // namespace sphc::host
