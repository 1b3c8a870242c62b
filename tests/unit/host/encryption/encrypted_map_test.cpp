#include "host/encryption/encrypted_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "tests/support/golden_encryption.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"

namespace sphc::host {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

std::string refusalOf(const std::vector<uint8_t> &file, const EncryptionKey &key) {
  return test::refusal([&] { decryptMap("a.enc", file, key); });
}

EncryptionKey goldenKey() {
  KeyBytes bytes;
  std::copy_n(test::goldenEncryptionKey().bytes, bytes.size(), bytes.begin());
  return EncryptionKey(bytes);
}

TEST(EncryptedMap, IsDecryptedByItsKey) {
  const EncryptionKey key = EncryptionKey::draw();
  for (const size_t bytes : {size_t{0}, size_t{1}, size_t{64}, size_t{100001}}) {
    const std::vector<uint8_t> map(bytes, 9);
    EXPECT_EQ(decryptMap("a.enc", encryptMap(map.data(), bytes, key), key), map);
  }
}

TEST(EncryptedMap, IsAnotherOneEachTime) {
  const EncryptionKey key = EncryptionKey::draw();
  const uint8_t map[] = {1, 2, 3};
  const std::vector<uint8_t> first = encryptMap(map, 3, key), second = encryptMap(map, 3, key);
  EXPECT_FALSE(std::equal(first.begin() + 40, first.begin() + 64, second.begin() + 40)) << "the nonce is drawn";
  EXPECT_FALSE(std::equal(first.begin() + 64, first.begin() + 67, second.begin() + 64) &&
               std::equal(first.begin() + 67, first.end(), second.begin() + 67));
}

TEST(EncryptedMap, TheGoldenFileIsDecrypted) {
  const std::vector<uint8_t> text = decryptMap("a.enc", test::goldenEncrypted(), goldenKey());
  EXPECT_EQ(std::string(text.begin(), text.end()), test::kGoldenText);
}

TEST(EncryptedMap, RefusalsSayWhyAndName) {
  std::vector<uint8_t> file = test::goldenEncrypted();
  EXPECT_THAT(refusalOf(file, EncryptionKey::draw()), HasSubstr("another key"));
  file.back() ^= 1;
  EXPECT_THAT(refusalOf(file, goldenKey()), HasSubstr("cannot decrypt a.enc"));
  EXPECT_THAT(refusalOf(file, goldenKey()), HasSubstr("[SPHC_E_ENCRYPTION_CHANGED]"));
  file.pop_back();
  EXPECT_THAT(refusalOf(file, goldenKey()), HasSubstr("was cut"));
  EXPECT_THAT(refusalOf({}, goldenKey()), HasSubstr("[SPHC_E_ENCRYPTION_FORMAT]"));
}

class EncryptionKeyTest : public testing::Test {
 protected:
  std::string refusal() const {
    try {
      EncryptionKey::read(path_);
    } catch (const std::runtime_error &error) {
      EXPECT_THAT(error.what(), HasSubstr(path_));
      return error.what();
    }
    return "read";
  }
  const test::TempFolder folder_;
  const std::string path_ = folder_ / "rooms.key";
};

TEST_F(EncryptionKeyTest, IsReadAsItWasWritten) {
  const EncryptionKey key = EncryptionKey::draw();
  key.write(path_);
  struct stat facts = {};
  ASSERT_EQ(stat(path_.c_str(), &facts), 0);
  EXPECT_EQ(facts.st_mode & 0777, 0600u);
  EXPECT_EQ(EncryptionKey::read(path_).idText(), key.idText());
  EXPECT_NE(EncryptionKey::draw().idText(), key.idText());
}

TEST_F(EncryptionKeyTest, WhatIsNoneIsRefused) {
  EXPECT_THAT(refusal(), HasSubstr("cannot be read"));
  std::ofstream(path_) << "spherecloud secret signing key 1\n" << std::string(64, 'a') << "\n";
  fs::permissions(path_, fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_THAT(refusal(), HasSubstr("holds a secret key that signs maps, and none of encrypted maps"));
  EXPECT_THAT(refusal(), Not(HasSubstr("aaaa")));
  std::ofstream(path_) << "spherecloud secret encryption key 1\n" << std::string(63, 'a') << "\n";  // cut
  EXPECT_THAT(refusal(), HasSubstr("holds no key of encrypted maps"));
}

TEST_F(EncryptionKeyTest, OneThatOthersReadIsRefused) {
  EncryptionKey::draw().write(path_);
  fs::permissions(path_, fs::perms::others_read, fs::perm_options::add);
  EXPECT_THAT(refusal(), HasSubstr("chmod 600"));
}

}  // namespace
}  // namespace sphc::host
