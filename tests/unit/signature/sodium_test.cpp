// Our verifier and libsodium's agree, whatever they are given.
#include <gtest/gtest.h>
#include <sodium.h>

#include <algorithm>
#include <array>

#include "signature/sha512.h"
#include "signature/statement.h"
#include "signature/strict_ed25519.h"
#include "tests/support/golden_signature.h"
#include "tests/support/random_numbers.h"

namespace sphc {
namespace {

using Bytes = std::vector<uint8_t>;

struct Pair {
  uint8_t key[32], secret[64];
};

Bytes randomBytes(size_t count, Random *random) {
  Bytes bytes(count);
  for (uint8_t &byte : bytes) byte = static_cast<uint8_t>(random->below(256));
  return bytes;
}

Pair pairOf(const Bytes &seed) {
  Pair pair;
  crypto_sign_seed_keypair(pair.key, pair.secret, seed.data());
  return pair;
}

struct Case {
  Bytes key, message, signature;
};

Case signedCase(Random *random) {
  const Pair pair = pairOf(randomBytes(32, random));
  Case made = {Bytes(pair.key, pair.key + 32), randomBytes(random->below(SPHC_ED25519_MESSAGE_MAX + 1), random),
               Bytes(64)};
  crypto_sign_detached(made.signature.data(), nullptr, made.message.data(), made.message.size(), pair.secret);
  return made;
}

bool weAccept(const Case &given) {
  return sphc_ed25519_verify(given.key.data(), given.message.data(), given.message.size(), given.signature.data());
}

// Whether both say the same; what they say is counted.
testing::AssertionResult agree(const Case &given, std::array<int, 2> *verdicts) {
  const bool theirs = crypto_sign_verify_detached(given.signature.data(), given.message.data(),
                                                  given.message.size(), given.key.data()) == 0;
  ++(*verdicts)[theirs];
  if (weAccept(given) == theirs) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "libsodium " << (theirs ? "accepts" : "refuses") << " a signature";
}

void flipBit(Bytes *bytes, Random *random) {
  if (bytes->empty()) return;
  const uint32_t bit = random->below(8 * static_cast<uint32_t>(bytes->size()));
  (*bytes)[bit / 8] = static_cast<uint8_t>((*bytes)[bit / 8] ^ 1u << bit % 8);
}

void addOrderToS(Bytes *signature, uint32_t times) {
  const Bytes order = test::bytesOfHex("edd3f55c1a631258d69cf7a2def9de1400000000000000000000000000000010");
  uint32_t carry = 0;
  for (size_t i = 0; i < 32; ++i) {
    carry += (*signature)[32 + i] + times * order[i];
    (*signature)[32 + i] = static_cast<uint8_t>(carry);
    carry >>= 8;
  }
}

// Near p, near 0, of small order, or anything.
Bytes oddPoint(Random *random) {
  Bytes point(32, random->below(2) ? uint8_t{0xff} : uint8_t{0});
  point[0] = static_cast<uint8_t>(random->below(256));
  if (random->below(4) == 0) point = randomBytes(32, random);
  if (random->below(4) == 0)
    point = test::bytesOfHex("26e8958fc2b227b045c3f489f2ef98f0d5dfac05d3c63339b13802886d53fc05");
  if (random->below(2)) point[31] = static_cast<uint8_t>(point[31] ^ 0x80);
  return point;
}

void spoil(Case *given, Random *random) {
  switch (random->below(7)) {
    case 0:
      return flipBit(&given->signature, random);
    case 1:
      return flipBit(&given->message, random);
    case 2:
      return flipBit(&given->key, random);
    case 3:
      return addOrderToS(&given->signature, 1 + random->below(15));
    case 4:
      given->key = oddPoint(random);
      return;
    case 5: {
      const Bytes point = oddPoint(random);
      std::copy(point.begin(), point.end(), given->signature.begin());
      return;
    }
    default: {  // a key of small order that signs everything
      given->key = oddPoint(random);
      std::fill(given->signature.begin(), given->signature.end(), uint8_t{0});
      std::copy(given->key.begin(), given->key.end(), given->signature.begin());
    }
  }
}

TEST(BesideSodium, SignaturesAreAccepted) {
  ASSERT_GE(sodium_init(), 0);
  Random random(81);
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(weAccept(signedCase(&random))) << i;
}

TEST(BesideSodium, SpoiledSignaturesAreJudgedAlike) {
  ASSERT_GE(sodium_init(), 0);
  Random random(82);
  std::array<int, 2> verdicts = {};
  for (int i = 0; i < 1000; ++i) {
    Case given = signedCase(&random);
    spoil(&given, &random);
    ASSERT_TRUE(agree(given, &verdicts)) << i;
  }
  EXPECT_GT(verdicts[0], 800);
}

// A key with a part of small order signs what a verifier with the cofactor accepts and one without it mostly does
// not.
TEST(BesideSodium, KeysWithAPartOfSmallOrderAreJudgedAlike) {
  ASSERT_GE(sodium_init(), 0);
  Random random(83);
  const Bytes small = test::bytesOfHex("26e8958fc2b227b045c3f489f2ef98f0d5dfac05d3c63339b13802886d53fc05");
  std::array<int, 2> verdicts = {};
  for (int i = 0; i < 100; ++i) {
    Bytes wide = randomBytes(64, &random), a(32), r(32), h(32), r_point(32), ha(32);
    Case given = {Bytes(32), randomBytes(20, &random), Bytes(64)};
    crypto_core_ed25519_scalar_reduce(a.data(), wide.data());
    ASSERT_EQ(crypto_scalarmult_ed25519_base_noclamp(given.key.data(), a.data()), 0);
    ASSERT_EQ(crypto_core_ed25519_add(given.key.data(), given.key.data(), small.data()), 0);
    wide = randomBytes(64, &random);
    crypto_core_ed25519_scalar_reduce(r.data(), wide.data());
    ASSERT_EQ(crypto_scalarmult_ed25519_base_noclamp(r_point.data(), r.data()), 0);
    Bytes hashed = r_point;
    hashed.insert(hashed.end(), given.key.begin(), given.key.end());
    hashed.insert(hashed.end(), given.message.begin(), given.message.end());
    crypto_hash_sha512(wide.data(), hashed.data(), hashed.size());
    crypto_core_ed25519_scalar_reduce(h.data(), wide.data());
    crypto_core_ed25519_scalar_mul(ha.data(), h.data(), a.data());
    std::copy(r_point.begin(), r_point.end(), given.signature.begin());
    crypto_core_ed25519_scalar_add(given.signature.data() + 32, r.data(), ha.data());
    ASSERT_TRUE(agree(given, &verdicts)) << i;
  }
  EXPECT_GT(verdicts[0], 50);  // seven of eight
  EXPECT_GT(verdicts[1], 2);
}

TEST(BesideSodium, HashesAreTheSame) {
  ASSERT_GE(sodium_init(), 0);
  Random random(84);
  for (uint32_t bytes = 0; bytes < 600; ++bytes) {
    const Bytes data = randomBytes(bytes, &random);
    uint8_t ours[SPHC_SHA512_BYTES], theirs[SPHC_SHA512_BYTES];
    sphc_sha512(data.data(), data.size(), ours);
    crypto_hash_sha512(theirs, data.data(), data.size());
    ASSERT_TRUE(std::equal(ours, ours + SPHC_SHA512_BYTES, theirs)) << bytes;
  }
}

TEST(BesideSodium, TheGoldenSignatureIsTheirs) {
  ASSERT_GE(sodium_init(), 0);
  const Pair pair = pairOf(test::bytesOfHex(test::kSeed));
  const std::vector<uint8_t> golden = test::bytesOfHex(test::kGoldenSignature);
  uint8_t signature[64];
  crypto_sign_detached(signature, nullptr, golden.data(), SPHC_STATEMENT_BYTES, pair.secret);
  EXPECT_TRUE(std::equal(signature, signature + 64, golden.begin() + SPHC_STATEMENT_BYTES));
  EXPECT_TRUE(std::equal(pair.key, pair.key + 32, test::keyOfHex(test::kKey).bytes));
}

}  // namespace
}  // namespace sphc
