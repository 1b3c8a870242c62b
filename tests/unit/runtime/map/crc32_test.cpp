#include "runtime/map/crc32.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "tests/support/map_bytes.h"
#include "tests/support/random_numbers.h"

namespace sphc {
namespace {

TEST(Crc32, KnownValues) {  // as zlib.crc32
  EXPECT_EQ(crc32(0, "", 0), 0u);
  EXPECT_EQ(crc32(0, "123456789", 9), 0xCBF43926u);
  EXPECT_EQ(crc32(0, "a", 1), 0xE8B7BE43u);
  EXPECT_EQ(crc32(0, "The quick brown fox jumps over the lazy dog", 43), 0x414FA339u);
  const std::vector<uint8_t> zeros(32, 0);
  EXPECT_EQ(crc32(0, zeros.data(), 32), 0x190A55ADu);
}

TEST(Crc32, EveryLengthAndAlignmentAsBitByBit) {
  Random random(1);
  std::vector<uint8_t> data(600);
  for (uint8_t &byte : data) byte = static_cast<uint8_t>(random.below(256));
  for (size_t start = 0; start < 9; ++start)
    for (size_t length = 0; length < 80; ++length)
      ASSERT_EQ(crc32(0, &data[start], length), test::slowCrc32(&data[start], length));
}

TEST(Crc32, GoesOnWhereItStopped) {
  const char *text = "The quick brown fox jumps over the lazy dog";
  for (size_t cut = 0; cut <= 43; ++cut) EXPECT_EQ(crc32(crc32(0, text, cut), text + cut, 43 - cut), 0x414FA339u);
}

}  // namespace
}  // namespace sphc
