#include "host/signing/signed_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "host/base/usage_error.h"
#include "host/base/write_file.h"
#include "tests/support/golden_signature.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"

namespace sphc::host {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(SignatureFile, StandsBesideTheMap) { EXPECT_EQ(signaturePath("maps/a.sphc"), "maps/a.sphc.sig"); }

class SignedMapTest : public testing::Test {
 protected:
  SignedMapTest() {
    SigningKey::Seed seed;
    const std::vector<uint8_t> bytes = test::bytesOfHex(test::kSeed);
    std::copy(bytes.begin(), bytes.end(), seed.begin());
    key_ = std::make_unique<SigningKey>(seed);
    trust_.keys = {key_->publicKey()};
    trust_.signature = path_;
  }

  void sign(uint64_t release, const std::string &name) {
    const Signature signature = signMap(map_.data(), map_.size(), *key_, release, name);
    writeFile(path_, signature.data(), signature.size());
  }
  sphc_signature_statement check() const { return checkSignature(trust_, "a.sphc", map_.data(), map_.size()); }
  std::string refusal() const {
    return test::refusal([&] { check(); });
  }

  const test::TempFolder folder_;
  const std::string path_ = folder_ / "a.sphc.sig";
  std::vector<uint8_t> map_ = test::goldenMap();
  std::unique_ptr<SigningKey> key_;
  Trust trust_;
};

TEST_F(SignedMapTest, IsTheGoldenOne) {
  const Signature signature = signMap(map_.data(), map_.size(), *key_, test::kGoldenRelease, test::kGoldenName);
  EXPECT_EQ(std::vector<uint8_t>(signature.begin(), signature.end()), test::bytesOfHex(test::kGoldenSignature));
}

TEST_F(SignedMapTest, IsAcceptedByWhoTrustsTheKey) {
  sign(3, "hall");
  trust_.name = "hall";
  trust_.least_release = 3;
  const sphc_signature_statement said = check();
  EXPECT_EQ(said.release, 3u);
  EXPECT_STREQ(said.name, "hall");
}

TEST_F(SignedMapTest, RefusalsSayWhyAndName) {
  EXPECT_THAT(refusal(), HasSubstr("not signed"));  // no file
  EXPECT_THAT(refusal(), HasSubstr("a.sphc"));
  EXPECT_THAT(refusal(), HasSubstr("[SPHC_E_SIGNATURE_MISSING]"));
  sign(3, "hall");
  fs::resize_file(path_, SPHC_SIGNATURE_BYTES + 1000);
  EXPECT_THAT(refusal(), HasSubstr("[SPHC_E_SIGNATURE_FORMAT]"));
  sign(3, "hall");
  trust_.least_release = 4;
  EXPECT_THAT(refusal(), HasSubstr("older release"));
  trust_ = {{test::keyOfHex(test::kOtherKey)}, 0, std::nullopt, path_};
  EXPECT_THAT(refusal(), HasSubstr("not trusted"));
}

TEST_F(SignedMapTest, NamesThatDoNotFitAreWrongUse) {
  EXPECT_THROW(sign(1, std::string(32, 'x')), UsageError);
  EXPECT_THROW(sign(1, std::string("a\0b", 3)), UsageError);
  const std::string no_text[] = {"\xff", "caf\xc3",  "\xc0\xaf", "\xed\xa0\x80", "\xf5\x80\x80\x80",
                                 "a\nb", "\x1b[31m", "\x7f",     "\xc2\x9b"};
  for (const std::string &name : no_text) EXPECT_THROW(sign(1, name), UsageError) << name;
  EXPECT_NO_THROW(sign(1, "caf\xc3\xa9 \xe5\x8e\xa8 \xf0\x9f\x8d\xb3"));
  EXPECT_NO_THROW(sign(1, std::string(31, 'x')));
  EXPECT_EQ(check().release, 1u);
}

TEST_F(SignedMapTest, AnEmptyNameIsOfAMapWithoutOne) {
  trust_.name = "";
  sign(1, "hall");
  EXPECT_THAT(refusal(), HasSubstr("another name"));
  sign(1, "");
  EXPECT_EQ(check().release, 1u);
}

TEST_F(SignedMapTest, AFileStatesItsReleaseAndName) {
  EXPECT_FALSE(statedBy(key_->publicKey(), path_));
  sign(9, "hall");
  const std::optional<Stated> stated = statedBy(key_->publicKey(), path_);
  ASSERT_TRUE(stated);
  EXPECT_EQ(stated->release, 9u);
  EXPECT_EQ(stated->name, "hall");
  EXPECT_FALSE(statedBy(test::keyOfHex(test::kOtherKey), path_));
}

}  // namespace
}  // namespace sphc::host
