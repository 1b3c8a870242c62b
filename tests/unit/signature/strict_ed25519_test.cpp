#include "signature/strict_ed25519.h"

#include <gtest/gtest.h>

#include "tests/support/golden_signature.h"

namespace sphc {
namespace {

using Bytes = std::vector<uint8_t>;

struct Signed {
  Bytes key, message, signature;

  bool verified() const {
    return sphc_ed25519_verify(key.data(), message.data(), message.size(), signature.data()) == 1;
  }
};

Signed signedOf(const char *key, const char *message, const char *signature) {
  return {test::bytesOfHex(key), test::bytesOfHex(message), test::bytesOfHex(signature)};
}

// RFC 8032, section 7.1.
const Signed kKnown[] = {
    signedOf("d75a980182b10ab7d54bfed3c964073a0ee172f3daa62325af021a68f707511a", "",
             "e5564300c360ac729086e2cc806e828a84877f1eb8e5d974d873e065224901555fb8821590a33bacc61e39701cf9b46b"
             "d25bf5f0595bbe24655141438e7a100b"),
    signedOf("3d4017c3e843895a92b70aa74d1b7ebc9c982ccf2ec4968cc0cd55f12af4660c", "72",
             "92a009a9f0d4cab8720e820b5f642540a2b27b5416503f8fb3762223ebdb69da085ac1e43e15996e458f3613d0f11d8c"
             "387b2eaeb4302aeeb00d291612bb0c00"),
    signedOf("fc51cd8e6218a1a38da47ed00230f0580816ed13ba3303ac5deb911548908025", "af82",
             "6291d657deec24024827e69c3abe01a30ce548a284743a445e3680d7db5ac3ac18ff9b538d16f290ae67f760984dc659"
             "4a7c15e9716ed28dc027beceea1ec40a"),
    signedOf("ec172b93ad5e563bf4932c70e1245034c35467ef2efd4d64ebf819683467e2bf",
             "ddaf35a193617abacc417349ae20413112e6fa4e89a97ea20a9eeee64b55d39a2192992a274fc1a836ba3c23a3feebbd"
             "454d4423643ce80e2a9ac94fa54ca49f",
             "dc2a4459e7369633a52b1bf277839a00201009a3efbf3ecb69bea2186c26b58909351fc9ac90b3ecfdfbc7c66431e030"
             "3dca179c138ac17ad9bef1177331a704")};

// y of the points whose order divides 8, and the same plus p where that fits into 255 bits.
const char *const kSmallOrder[] = {"0000000000000000000000000000000000000000000000000000000000000000",
                                   "0100000000000000000000000000000000000000000000000000000000000000",
                                   "ecffffffffffffffffffffffffffffffffffffffffffffffffffffffffffff7f",
                                   "26e8958fc2b227b045c3f489f2ef98f0d5dfac05d3c63339b13802886d53fc05",
                                   "c7176a703d4dd84fba3c0b760d10670f2a2053fa2c39ccc64ec7fd7792ac037a",
                                   "edffffffffffffffffffffffffffffffffffffffffffffffffffffffffffff7f",
                                   "eeffffffffffffffffffffffffffffffffffffffffffffffffffffffffffff7f"};

TEST(StrictEd25519, KnownAnswers) {
  for (const Signed &known : kKnown) EXPECT_TRUE(known.verified());
}

TEST(StrictEd25519, EveryPartCounts) {
  const Signed &good = kKnown[2];
  for (Bytes Signed::*part : {&Signed::key, &Signed::message, &Signed::signature}) {
    for (size_t bit = 0; bit < 8 * (good.*part).size(); bit += 5) {
      Signed bad = good;
      (bad.*part)[bit / 8] = static_cast<uint8_t>((bad.*part)[bit / 8] ^ 1u << bit % 8);
      ASSERT_FALSE(bad.verified()) << "bit " << bit;
    }
  }
}

// S + L means the same number, and a verifier that takes it gives a message two signatures.
TEST(StrictEd25519, NumbersFromTheOrderOnAreRefused) {
  const Bytes order = test::bytesOfHex("edd3f55c1a631258d69cf7a2def9de1400000000000000000000000000000010");
  Signed twice = kKnown[1];
  uint32_t carry = 0;
  for (size_t i = 0; i < order.size(); ++i) {
    carry += twice.signature[32 + i] + order[i];
    twice.signature[32 + i] = static_cast<uint8_t>(carry);
    carry >>= 8;
  }
  EXPECT_FALSE(twice.verified());
  Signed zero = kKnown[1];
  std::copy(order.begin(), order.end(), zero.signature.begin() + 32);
  EXPECT_FALSE(zero.verified());
}

// With such a key, R = key and S = 0 sign any message, or one of eight, for everybody.
TEST(StrictEd25519, PointsOfSmallOrderAreRefused) {
  for (const char *text : kSmallOrder) {
    for (const uint8_t sign : {uint8_t{0}, uint8_t{0x80}}) {
      Bytes point = test::bytesOfHex(text);
      point[31] = static_cast<uint8_t>(point[31] | sign);
      EXPECT_FALSE(sphc_ed25519_is_good_key(point.data())) << text;
      Bytes signature = point;
      signature.resize(64);
      for (uint8_t first = 0; first < 16; ++first) EXPECT_FALSE((Signed{point, {first}, signature}).verified());
      Signed by_r = kKnown[0];
      std::copy(point.begin(), point.end(), by_r.signature.begin());
      EXPECT_FALSE(by_r.verified()) << text;
    }
  }
}

// y from p on is another way to write y - p.
TEST(StrictEd25519, OtherWaysToWriteAPointAreRefused) {
  for (unsigned above = 0; above < 19; ++above) {
    Bytes point(32, 0xff);
    point[0] = static_cast<uint8_t>(0xed + above);
    for (const uint8_t top : {uint8_t{0x7f}, uint8_t{0xff}}) {
      point[31] = top;
      EXPECT_FALSE(sphc_ed25519_is_good_key(point.data())) << above;
    }
  }
  Bytes below(32, 0xff);  // p - 2
  below[0] = 0xeb;
  below[31] = 0x7f;
  EXPECT_TRUE(sphc_ed25519_is_good_key(below.data()));
}

TEST(StrictEd25519, KeysThatAreNoPointAreRefused) {
  Signed no_point = kKnown[0];
  no_point.key.assign(32, 0);
  no_point.key[0] = 2;  // (y^2 - 1) / (d y^2 + 1) has no root
  EXPECT_FALSE(no_point.verified());
}

TEST(StrictEd25519, MessagesThatDoNotFitAreRefused) {
  Signed longer = kKnown[0];
  longer.message.assign(SPHC_ED25519_MESSAGE_MAX + 1, 0);
  EXPECT_FALSE(longer.verified());
}

}  // namespace
}  // namespace sphc
