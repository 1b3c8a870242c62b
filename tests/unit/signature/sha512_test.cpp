#include "signature/sha512.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "tests/support/golden_signature.h"

namespace sphc {
namespace {

std::vector<uint8_t> hashOf(const std::string &text) {
  std::vector<uint8_t> hash(SPHC_SHA512_BYTES);
  sphc_sha512(text.data(), text.size(), hash.data());
  return hash;
}

// FIPS 180-2, appendix C; RFC 6234, section 8.5.
TEST(Sha512, KnownAnswers) {
  EXPECT_EQ(hashOf(""), test::bytesOfHex("cf83e1357eefb8bdf1542850d66d8007d620e4050b5715dc83f4a921d36ce9ce"
                                         "47d0d13c5d85f2b0ff8318d2877eec2f63b931bd47417a81a538327af927da3e"));
  EXPECT_EQ(hashOf("abc"), test::bytesOfHex("ddaf35a193617abacc417349ae20413112e6fa4e89a97ea20a9eeee64b55d39a"
                                            "2192992a274fc1a836ba3c23a3feebbd454d4423643ce80e2a9ac94fa54ca49f"));
  EXPECT_EQ(
      hashOf("abcdefghbcdefghicdefghijdefghijkefghijklfghijklmghijklmnhijklmnoijklmnopjklmnopqklmnopqrlmnopqrs"
             "mnopqrstnopqrstu"),
      test::bytesOfHex("8e959b75dae313da8cf4f72814fc143f8f7779c6eb9f7fa17299aeadb6889018"
                       "501d289e4900f7e4331b99dec4b5433ac7d329eeb6dd26545e96e55b874be909"));
  EXPECT_EQ(hashOf(std::string(1000000, 'a')),
            test::bytesOfHex("e718483d0ce769644e2e42c7bc15b4638e1f98b13b2044285632a803afa973eb"
                             "de0ff244877ea60a4cb0432ce577c31beb009c5c2c49aa2e4eadb217ad8cc09b"));
}

// With exactly as many bytes as it may read.
TEST(Sha512, EveryLengthAroundABlockGivesAnotherHash) {
  std::vector<std::vector<uint8_t>> hashes;
  for (size_t bytes = 0; bytes < 300; ++bytes) {
    const std::unique_ptr<uint8_t[]> data(new uint8_t[bytes]());
    hashes.emplace_back(SPHC_SHA512_BYTES);
    sphc_sha512(data.get(), bytes, hashes.back().data());
  }
  std::sort(hashes.begin(), hashes.end());
  EXPECT_EQ(std::unique(hashes.begin(), hashes.end()), hashes.end());
}

}  // namespace
}  // namespace sphc
