#include "encryption/file_header.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/golden_encryption.h"

namespace sphc {
namespace {

TEST(EncryptionHeader, IsReadAndWritten) {
  const std::vector<uint8_t> golden = test::goldenEncrypted();
  sphc_encryption_header header;
  ASSERT_TRUE(sphc_encryption_header_read(golden.data(), &header));
  EXPECT_EQ(header.map_bytes, std::string(test::kGoldenText).size());
  EXPECT_EQ(header.nonce[0], 0x40);
  EXPECT_EQ(header.nonce[23], 0x57);
  uint8_t bytes[SPHC_ENCRYPTION_HEADER_BYTES];
  sphc_encryption_header_write(&header, bytes);
  EXPECT_TRUE(std::equal(bytes, bytes + sizeof bytes, golden.begin()));
}

TEST(EncryptionHeader, OtherVersionsAreRefused) {
  std::vector<uint8_t> golden = test::goldenEncrypted();
  golden[15] = '2';
  sphc_encryption_header header = {};
  EXPECT_FALSE(sphc_encryption_header_read(golden.data(), &header));
  EXPECT_EQ(header.map_bytes, 0u);
}

TEST(EncryptionKeyId, IsOfTheKeyAndNotInIt) {
  const sphc_encryption_key key = test::goldenEncryptionKey();
  sphc_encryption_key other = key;
  other.bytes[31] ^= 1;
  uint8_t id[SPHC_ENCRYPTION_KEY_ID_BYTES], other_id[SPHC_ENCRYPTION_KEY_ID_BYTES];
  sphc_encryption_key_id(&key, id);
  sphc_encryption_key_id(&other, other_id);
  EXPECT_EQ(std::vector<uint8_t>(id, id + sizeof id), test::bytesOfHex("7913a407b1901038c04b9c9334e0e521"));
  EXPECT_FALSE(std::equal(id, id + sizeof id, other_id));
}

}  // namespace
}  // namespace sphc
