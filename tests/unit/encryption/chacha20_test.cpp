#include "encryption/chacha20.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/support/hex_bytes.h"

namespace sphc {
namespace {

std::vector<uint8_t> countedKey() {
  std::vector<uint8_t> key(32);
  std::iota(key.begin(), key.end(), uint8_t{0});
  return key;
}

std::vector<uint8_t> stream(uint32_t counter, size_t bytes) {
  const std::vector<uint8_t> nonce = test::bytesOfHex("000000090000004a00000000");
  std::vector<uint8_t> made(bytes);
  sphc_chacha20_xor(countedKey().data(), nonce.data(), counter, made.data(), made.data(), bytes);
  return made;
}

// RFC 8439, section 2.3.2.
TEST(Chacha20, KnownAnswer) {
  EXPECT_EQ(stream(1, 64), test::bytesOfHex("10f1e7e4d13b5915500fdd1fa32071c4c7d1f4c733c068030422aa9ac3d46c4e"
                                            "d2826446079faa0914c2d705d98b02a2b5129cd1de164eb9cbd083e8a2503c4e"));
}

TEST(Chacha20, BlocksAreCounted) {
  const std::vector<uint8_t> three = stream(1, 150), second = stream(2, 64), third = stream(3, 22);
  EXPECT_TRUE(std::equal(second.begin(), second.end(), three.begin() + 64));
  EXPECT_TRUE(std::equal(third.begin(), third.end(), three.begin() + 128));
}

TEST(Chacha20, TwiceIsNothing) {
  const std::vector<uint8_t> nonce(12, 7);
  std::vector<uint8_t> text(100, 42);
  for (int i = 0; i < 2; ++i)
    sphc_chacha20_xor(countedKey().data(), nonce.data(), 9, text.data(), text.data(), text.size());
  EXPECT_EQ(text, std::vector<uint8_t>(100, 42));
}

// draft-irtf-cfrg-xchacha-03, section 2.2.1.
TEST(Hchacha20, KnownAnswer) {
  std::vector<uint8_t> derived(32);
  sphc_hchacha20(countedKey().data(), test::bytesOfHex("000000090000004a0000000031415927").data(), derived.data());
  EXPECT_EQ(derived, test::bytesOfHex("82413b4227b27bfed30e42508a877d73a0f9e4d58a74a853c12ec41326d3ecdc"));
}

}  // namespace
}  // namespace sphc
