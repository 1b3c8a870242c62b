#include "encryption/wipe.h"

#include <gtest/gtest.h>

#include <vector>

namespace sphc {
namespace {

TEST(Wipe, LeavesZeroesAndTheNeighbours) {
  std::vector<uint8_t> bytes(10, 7);
  sphc_wipe(bytes.data() + 2, 5);
  EXPECT_EQ(bytes, (std::vector<uint8_t>{7, 7, 0, 0, 0, 0, 0, 7, 7, 7}));
}

}  // namespace
}  // namespace sphc
