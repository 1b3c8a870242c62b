#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "spherecloud/spherecloud_encryption.h"
#include "tests/support/golden_encryption.h"

namespace sphc {
namespace {

using testing::HasSubstr;

class EncryptionTest : public testing::Test {
 protected:
  sphc_encryption_key key_ = test::goldenEncryptionKey();
  std::vector<uint8_t> file_ = test::goldenEncrypted();
  std::vector<uint8_t> map_ = std::vector<uint8_t>(file_.size() - SPHC_ENCRYPTION_ADDED_BYTES, 1);
  sphc_message message_ = {};

  sphc_status decrypt() {
    return sphc_encryption_decrypt(&key_, file_.data(), file_.size(), map_.data(), map_.size(), &message_);
  }
  // Refused, with words, and nothing was written.
  void expectRefused(sphc_status status, const std::string &why) {
    const std::vector<uint8_t> before = map_;
    EXPECT_EQ(decrypt(), status);
    EXPECT_THAT(message_.text, HasSubstr(why));
    EXPECT_EQ(map_, before);
  }
};

TEST_F(EncryptionTest, AFileIsDecrypted) {
  ASSERT_EQ(decrypt(), SPHC_OK);
  EXPECT_EQ(std::string(map_.begin(), map_.end()), test::kGoldenText);
  EXPECT_EQ(sphc_encryption_decrypt(&key_, file_.data(), file_.size(), map_.data(), map_.size(), nullptr), SPHC_OK);
}

TEST_F(EncryptionTest, InPlaceToo) {
  uint8_t *map = file_.data() + SPHC_ENCRYPTION_HEADER_BYTES;
  ASSERT_EQ(sphc_encryption_decrypt(&key_, file_.data(), file_.size(), map, map_.size(), nullptr), SPHC_OK);
  EXPECT_EQ(std::string(map, map + map_.size()), test::kGoldenText);
}

TEST_F(EncryptionTest, AnotherKeyIsTold) {
  key_.bytes[0] ^= 1;
  expectRefused(SPHC_E_ENCRYPTION_KEY, "another key");
}

TEST_F(EncryptionTest, EveryBitOfTheFileIsHeld) {
  for (size_t i = 0; i < file_.size(); ++i) {
    file_[i] = static_cast<uint8_t>(file_[i] ^ 1 << i % 8);
    expectRefused(i < 24   ? SPHC_E_ENCRYPTION_FORMAT
                  : i < 40 ? SPHC_E_ENCRYPTION_KEY
                           : SPHC_E_ENCRYPTION_CHANGED,
                  "");
    file_[i] = static_cast<uint8_t>(file_[i] ^ 1 << i % 8);
  }
}

TEST_F(EncryptionTest, ACutFileIsRefused) {
  const std::vector<uint8_t> whole = file_;
  for (size_t bytes = 0; bytes < whole.size(); ++bytes) {
    file_.resize(bytes);
    map_.assign(bytes < SPHC_ENCRYPTION_ADDED_BYTES ? 1 : bytes - SPHC_ENCRYPTION_ADDED_BYTES + 1, 1);
    if (bytes >= SPHC_ENCRYPTION_ADDED_BYTES) map_.pop_back();
    uint8_t nothing = 0;
    EXPECT_EQ(sphc_encryption_decrypt(&key_, file_.empty() ? &nothing : file_.data(), bytes,
                                      map_.empty() ? &nothing : map_.data(), map_.size(), nullptr),
              SPHC_E_ENCRYPTION_FORMAT)
        << bytes;
    file_ = whole;
  }
}

TEST_F(EncryptionTest, WrongCallsAreRefused) {
  EXPECT_EQ(sphc_encryption_decrypt(nullptr, file_.data(), file_.size(), map_.data(), map_.size(), nullptr),
            SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_encryption_decrypt(&key_, nullptr, file_.size(), map_.data(), map_.size(), nullptr),
            SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_encryption_decrypt(&key_, file_.data(), file_.size(), nullptr, map_.size(), nullptr),
            SPHC_E_ARGUMENT);
  map_.push_back(1);
  expectRefused(SPHC_E_ARGUMENT, "map_bytes is not");
  map_.pop_back();
  for (const size_t overlap : {size_t{0}, size_t{63}, size_t{65}, file_.size() - 1})
    EXPECT_EQ(
        sphc_encryption_decrypt(&key_, file_.data(), file_.size(), file_.data() + overlap, map_.size(), &message_),
        SPHC_E_ARGUMENT);
  EXPECT_THAT(message_.text, HasSubstr("map overlaps the file"));
  EXPECT_EQ(file_, test::goldenEncrypted());
}

TEST(EncryptionStatus, HasAName) {
  EXPECT_STREQ(sphc_encryption_status_name(SPHC_E_ENCRYPTION_FORMAT), "SPHC_E_ENCRYPTION_FORMAT");
  EXPECT_STREQ(sphc_encryption_status_name(SPHC_E_ENCRYPTION_KEY), "SPHC_E_ENCRYPTION_KEY");
  EXPECT_STREQ(sphc_encryption_status_name(SPHC_E_ENCRYPTION_CHANGED), "SPHC_E_ENCRYPTION_CHANGED");
  EXPECT_STREQ(sphc_encryption_status_name(SPHC_OK), "SPHC_OK");
}

}  // namespace
}  // namespace sphc
