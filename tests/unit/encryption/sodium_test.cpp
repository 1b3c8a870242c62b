// What libsodium encrypts is decrypted here, and nothing else.
#include <gtest/gtest.h>
#include <sodium.h>

#include <algorithm>

#include "encryption/aead.h"
#include "encryption/poly1305.h"
#include "tests/support/golden_encryption.h"
#include "tests/support/random_numbers.h"

namespace sphc {
namespace {

using Bytes = std::vector<uint8_t>;

// All ones or zeroes at times: the edges of the arithmetic.
Bytes randomBytes(size_t count, Random *random) {
  Bytes bytes(count);
  const uint32_t kind = random->below(6);
  for (uint8_t &byte : bytes)
    byte = static_cast<uint8_t>(kind == 0 ? 255 : kind == 1 ? random->below(2) * 255 : random->below(256));
  return bytes;
}

TEST(BesideSodium, TextsAreDecrypted) {
  ASSERT_GE(sodium_init(), 0);
  Random random(91);
  for (uint32_t bytes = 0; bytes < 400; ++bytes) {
    const Bytes key = randomBytes(32, &random), nonce = randomBytes(24, &random),
                plain = randomBytes(bytes, &random), header = randomBytes(random.below(100), &random);
    Bytes cipher(bytes + 1), tag(16), opened(bytes + 1);
    crypto_aead_xchacha20poly1305_ietf_encrypt_detached(cipher.data(), tag.data(), nullptr, plain.data(), bytes,
                                                        header.data(), header.size(), nullptr, nonce.data(),
                                                        key.data());
    const sphc_aead_text text = {header.data(), header.size(), cipher.data(), bytes, tag.data()};
    ASSERT_TRUE(sphc_aead_open(key.data(), nonce.data(), &text, opened.data())) << bytes;
    ASSERT_TRUE(std::equal(plain.begin(), plain.end(), opened.begin())) << bytes;
  }
}

TEST(BesideSodium, TagsAreTheSame) {
  ASSERT_GE(sodium_init(), 0);
  Random random(92);
  for (int i = 0; i < 3000; ++i) {
    const Bytes key = randomBytes(32, &random), data = randomBytes(16 * random.below(12), &random);
    uint8_t ours[16], theirs[16];
    sphc_poly1305 state;
    sphc_poly1305_init(&state, key.data());
    sphc_poly1305_add_padded(&state, data.data(), data.size());
    sphc_poly1305_tag(&state, ours);
    crypto_onetimeauth(theirs, data.data(), data.size(), key.data());
    ASSERT_TRUE(std::equal(ours, ours + 16, theirs)) << i;
  }
}

TEST(BesideSodium, TheGoldenFileIsTheirs) {
  ASSERT_GE(sodium_init(), 0);
  const Bytes golden = test::goldenEncrypted();
  Bytes plain(golden.size() - SPHC_ENCRYPTION_ADDED_BYTES);
  ASSERT_EQ(crypto_aead_xchacha20poly1305_ietf_decrypt(
                plain.data(), nullptr, nullptr, golden.data() + SPHC_ENCRYPTION_HEADER_BYTES,
                golden.size() - SPHC_ENCRYPTION_HEADER_BYTES, golden.data(), SPHC_ENCRYPTION_HEADER_BYTES,
                golden.data() + 40, test::goldenEncryptionKey().bytes),
            0);
  EXPECT_EQ(std::string(plain.begin(), plain.end()), test::kGoldenText);
}

}  // namespace
}  // namespace sphc
