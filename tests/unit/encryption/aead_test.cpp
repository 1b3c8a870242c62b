#include "encryption/aead.h"

#include <gtest/gtest.h>

#include "tests/support/golden_encryption.h"

namespace sphc {
namespace {

// draft-irtf-cfrg-xchacha-03, appendix A.3.1.
class AeadTest : public testing::Test {
 protected:
  std::vector<uint8_t> header_ = test::bytesOfHex("50515253c0c1c2c3c4c5c6c7"),
                       tag_ = test::bytesOfHex("c0875924c1c7987947deafd8780acf49"),
                       nonce_ = test::bytesOfHex("404142434445464748494a4b4c4d4e4f5051525354555657");
  std::vector<uint8_t> file_ = test::goldenEncrypted();
  std::vector<uint8_t> cipher_{file_.begin() + SPHC_ENCRYPTION_HEADER_BYTES, file_.end() - SPHC_AEAD_TAG_BYTES};
  std::vector<uint8_t> plain_ = std::vector<uint8_t>(cipher_.size());

  int open() {
    const sphc_aead_text text = {header_.data(), header_.size(), cipher_.data(), cipher_.size(), tag_.data()};
    return sphc_aead_open(test::goldenEncryptionKey().bytes, nonce_.data(), &text, plain_.data());
  }
};

TEST_F(AeadTest, KnownAnswer) {
  ASSERT_TRUE(open());
  EXPECT_EQ(std::string(plain_.begin(), plain_.end()), test::kGoldenText);
}

TEST_F(AeadTest, EveryBitIsAuthenticated) {
  for (std::vector<uint8_t> *part : {&header_, &tag_, &nonce_, &cipher_})
    for (uint8_t &byte : *part)
      for (int bit = 0; bit < 8; ++bit) {
        byte = static_cast<uint8_t>(byte ^ 1 << bit);
        EXPECT_FALSE(open());
        byte = static_cast<uint8_t>(byte ^ 1 << bit);
      }
  EXPECT_EQ(plain_, std::vector<uint8_t>(cipher_.size())) << "what is refused is not decrypted";
  EXPECT_TRUE(open());
}

TEST_F(AeadTest, LengthsAreAuthenticated) {
  header_.push_back(0);  // the block that is summed stays the same
  EXPECT_FALSE(open());
}

}  // namespace
}  // namespace sphc
