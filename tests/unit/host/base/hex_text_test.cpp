#include "host/base/hex_text.h"

#include <gtest/gtest.h>

namespace sphc::host {
namespace {

TEST(HexText, HasTwoDigitsAByte) {
  const uint8_t bytes[] = {0x00, 0xA5, 0xFF};
  EXPECT_EQ(hexText(bytes, 3), "00a5ff");
}

}  // namespace
}  // namespace sphc::host
