#include "host/signing/key_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <stdexcept>

#include "tests/support/golden_signature.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"

namespace sphc::host {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class KeyFileTest : public testing::Test {
 protected:
  std::string at(const std::string &name) const { return folder_ / name; }
  std::string text(const std::string &name) const { return folder_.read(name); }
  void put(const std::string &name, const std::string &content) const {
    fs::permissions(folder_.write(name, content), fs::perms::owner_read | fs::perms::owner_write);
  }
  // What reading says, which names the file and never what it holds.
  template <typename Read>
  std::string refusal(const Read &read, const std::string &name, const std::string &secret = "") const {
    try {
      read(at(name));
    } catch (const std::runtime_error &error) {
      EXPECT_THAT(error.what(), HasSubstr(at(name)));
      if (!secret.empty()) {
        EXPECT_THAT(error.what(), Not(HasSubstr(secret)));
      }
      return error.what();
    }
    ADD_FAILURE() << name << " was read";
    return "";
  }

  const test::TempFolder folder_;
};

SigningKey goldenKey() {
  SigningKey::Seed seed;
  const std::vector<uint8_t> bytes = test::bytesOfHex(test::kSeed);
  std::copy(bytes.begin(), bytes.end(), seed.begin());
  return SigningKey(seed);
}

TEST_F(KeyFileTest, AKeyIsReadAsItWasWritten) {
  const SigningKey key = SigningKey::draw();
  key.write(at("maps.key"), at("maps.key.pub"));
  struct stat facts = {};
  ASSERT_EQ(stat(at("maps.key").c_str(), &facts), 0);
  EXPECT_EQ(facts.st_mode & 0777, 0600u);
  const SigningKey read = SigningKey::read(at("maps.key"));
  const uint8_t bytes[] = {1, 2, 3};
  EXPECT_EQ(read.sign(bytes, 3), key.sign(bytes, 3));
  EXPECT_EQ(keyIdText(readPublicKey(at("maps.key.pub"))), keyIdText(key.publicKey()));
  EXPECT_THAT(text("maps.key.pub"), Not(HasSubstr(text("maps.key").substr(33, 64))));
}

TEST_F(KeyFileTest, TheSeedGivesThePublicKeyOfTheStandard) {
  goldenKey().write(at("golden.key"), at("golden.pub"));
  EXPECT_EQ(text("golden.key"), std::string("spherecloud secret signing key 1\n") + test::kSeed + "\n");
  EXPECT_EQ(text("golden.pub"), std::string("spherecloud public signing key 1\n") + test::kKey + "\n");
}

// As where the disk is full: half a pair would only be in the way of the next one.
TEST_F(KeyFileTest, APairIsWrittenWholeOrNotAtAll) {
  const std::string nowhere = at("absent/half.key.pub");
  EXPECT_THAT(test::refusal([&] { goldenKey().write(at("half.key"), nowhere); }),
              AllOf(HasSubstr("cannot write " + nowhere + ":"), Not(HasSubstr(".part"))));
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(KeyFileTest, TwoKeysDiffer) {
  EXPECT_NE(keyIdText(SigningKey::draw().publicKey()), keyIdText(SigningKey::draw().publicKey()));
}

TEST_F(KeyFileTest, ASecretThatOthersReadIsRefused) {
  goldenKey().write(at("open.key"), at("open.pub"));
  fs::permissions(at("open.key"), fs::perms::others_read, fs::perm_options::add);
  EXPECT_THAT(refusal(SigningKey::read, "open.key", test::kSeed), HasSubstr("chmod 600"));
}

TEST_F(KeyFileTest, FilesThatHoldNoSecretKeyAreRefused) {
  const std::string head = "spherecloud secret signing key 1\n", seed = test::kSeed;
  const std::string bad[] = {"",
                             seed + "\n",
                             head,
                             head + seed.substr(1) + "\n",
                             head + seed + "0\n",
                             head + seed + "\nmore",
                             head + "z" + seed.substr(1) + "\n"};
  for (const std::string &content : bad) {
    put("bad.key", content);
    EXPECT_THAT(refusal(SigningKey::read, "bad.key", seed.substr(1)), HasSubstr("holds no secret key")) << content;
  }
  EXPECT_THAT(refusal(SigningKey::read, "absent.key"),
              HasSubstr("cannot be read: No such file or directory; give the file"));
}

// Everybody may read it, and that is not what is wrong with it.
TEST_F(KeyFileTest, APublicKeyInPlaceOfTheSecretOneIsNamed) {
  goldenKey().write(at("maps.key"), at("maps.key.pub"));
  fs::permissions(at("maps.key.pub"), fs::perms(0644));
  EXPECT_THAT(refusal(SigningKey::read, "maps.key.pub"),
              AllOf(HasSubstr("holds a public key"), HasSubstr("file without .pub"), Not(HasSubstr("chmod"))));
}

TEST_F(KeyFileTest, AKeyOfEncryptedMapsIsNamed) {
  put("rooms.key", std::string("spherecloud secret encryption key 1\n") + test::kSeed + "\n");
  EXPECT_THAT(refusal(SigningKey::read, "rooms.key", test::kSeed),
              HasSubstr("holds a key of encrypted maps, and only a secret one of signatures signs"));
  EXPECT_THAT(refusal(readPublicKey, "rooms.key", test::kSeed), HasSubstr("holds a key of encrypted maps"));
}

TEST_F(KeyFileTest, ASecretIsNeverTakenForAPublicKey) {
  goldenKey().write(at("maps.key"), at("maps.key.pub"));
  EXPECT_THAT(refusal(readPublicKey, "maps.key", test::kSeed), HasSubstr("ending in .pub"));
}

TEST_F(KeyFileTest, AKeyForWhichAnybodySignsIsRefused) {
  put("weak.pub", "spherecloud public signing key 1\n01" + std::string(62, '0') + "\n");
  EXPECT_THAT(refusal(readPublicKey, "weak.pub"), HasSubstr("anybody can sign"));
}

}  // namespace
}  // namespace sphc::host
