// Maps are signed, verified and refused by the command.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "command_runner.h"
#include "host/cli/common/exit_code.h"
#include "tests/support/temp_folder.h"
#include "tests/unit/host/tiny_map.h"

namespace sphc::host {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

// A map, signed as release 7 of "kitchen", and two keys.
class SigningTest : public testing::Test {
 protected:
  SigningTest() : map_(folder_ / "room.sphc"), key_(folder_ / "maps.key") {
    writeTinyMap(map_, 40);
    EXPECT_EQ(runCommand("key --out " + key_).exit_code, kExitDone);
    EXPECT_EQ(runCommand("key --out " + (folder_ / "other.key")).exit_code, kExitDone);
    EXPECT_EQ(sign("--release 7 --name kitchen").exit_code, kExitDone);
  }

  Answer sign(const std::string &more) const { return runCommand("sign " + map_ + " --key " + key_ + " " + more); }
  Answer verify(const std::string &more = "") const {
    return runCommand("verify " + map_ + " --trusted-key " + key_ + ".pub " + more);
  }
  void expectRefused(const std::string &trust, const std::string &why) const {
    for (const std::string &command :
         {"inspect " + map_ + " --no-picture", "live --device simulated: --frames 1 --map " + map_}) {
      const Answer answer = runCommand(command + " " + trust);
      EXPECT_EQ(answer.exit_code, kExitFailure) << command;
      EXPECT_THAT(answer.err, HasSubstr(why)) << command;
    }
  }

  test::TempFolder folder_;
  std::string map_, key_;
};

TEST_F(SigningTest, ASignedMapIsVerified) {
  const Answer answer = verify("--least-release 7 --name kitchen --json");
  ASSERT_EQ(answer.exit_code, kExitDone) << answer.err;
  const auto said = nlohmann::json::parse(answer.out);
  EXPECT_EQ(said["release"], 7);
  EXPECT_EQ(said["name"], "kitchen");
  EXPECT_EQ(runCommand("inspect " + map_ + " --no-picture --trusted-key " + key_ + ".pub").exit_code, kExitDone);
}

TEST_F(SigningTest, RefusalsHaveACause) {
  const std::string trust = "--trusted-key " + key_ + ".pub";
  EXPECT_THAT(verify("--least-release 8").err, HasSubstr("older release"));
  expectRefused(trust + " --least-release 8", "older release");
  EXPECT_THAT(verify("--name hall").err, HasSubstr("another name"));
  expectRefused("--trusted-key " + (folder_ / "other.key.pub"), "not trusted");
  std::ofstream(map_, std::ios::app) << 'x';
  expectRefused(trust, "another map, or the map was changed");
  std::ofstream(map_ + ".sig") << std::string(208, 'x');
  expectRefused(trust, "no signature of a map");
  fs::remove(map_ + ".sig");
  expectRefused(trust, "only signed maps are accepted");
}

TEST_F(SigningTest, ANamedSignatureThatIsMissingIsSaidToBe) {
  const std::string missing = folder_ / "none.sig";
  const Answer answer = verify("--signature " + missing);
  EXPECT_EQ(answer.exit_code, kExitFailure);
  EXPECT_THAT(answer.err, HasSubstr("--signature: " + missing + " is missing; give the file that"));
  EXPECT_THAT(answer.err, Not(HasSubstr("not signed")));
  EXPECT_EQ(verify("--signature " + map_ + ".sig").exit_code, kExitDone);
}

// As of a script in which a variable is not set: "any" would accept too much.
TEST_F(SigningTest, VerifyTakesTheNameAtItsWord) {
  EXPECT_THAT(verify("--name ''").err, HasSubstr("another name"));
  EXPECT_EQ(sign("--release 8 --force").exit_code, kExitDone);
  EXPECT_EQ(verify("--name ''").exit_code, kExitDone);
  const Answer too_long = verify("--name " + std::string(32, 'x'));
  EXPECT_EQ(too_long.exit_code, kExitUsage);
  EXPECT_THAT(too_long.err, HasSubstr("--name: a name has at most 31 bytes"));
}

TEST_F(SigningTest, LocalizeRefusesToo) {
  const std::string walk = folder_ / "walk";
  ASSERT_EQ(runCommand("simulate --frames 1 --rate 1 --out " + walk).exit_code, kExitDone);
  const std::string localize = "localize --recording " + walk + " --map " + map_ + " --trusted-key ";
  EXPECT_EQ(runCommand(localize + key_ + ".pub").exit_code, kExitNotLocalized);
  const Answer answer = runCommand(localize + (folder_ / "other.key.pub"));
  EXPECT_EQ(answer.exit_code, kExitFailure);
  EXPECT_THAT(answer.err, HasSubstr("not trusted"));
}

TEST_F(SigningTest, ReleasesOnlyGrow) {
  const Answer older = sign("--release 6 --name kitchen");
  EXPECT_EQ(older.exit_code, kExitFailure);
  EXPECT_THAT(older.err, HasSubstr("states release 7 already"));
  EXPECT_EQ(sign("--release 8 --name kitchen").exit_code, kExitDone);
  EXPECT_EQ(sign("--release 6 --name kitchen --force").exit_code, kExitDone);
  EXPECT_EQ(verify("--least-release 6").exit_code, kExitDone);
}

TEST_F(SigningTest, AReleaseIsOneMap) {
  EXPECT_EQ(sign("--release 7 --name kitchen").exit_code, kExitDone) << "the same map again";
  writeTinyMap(map_, 41);
  const Answer another = sign("--release 7 --name kitchen");
  EXPECT_EQ(another.exit_code, kExitFailure);
  EXPECT_THAT(another.err, HasSubstr("states this release of another map"));
  EXPECT_EQ(sign("--release 8 --name kitchen").exit_code, kExitDone);
}

TEST_F(SigningTest, ASignatureOfAnotherNameStays) {
  for (const char *options : {"--release 9 --name hall", "--release 9"}) {
    const Answer other = sign(options);
    EXPECT_EQ(other.exit_code, kExitFailure);
    EXPECT_THAT(other.err, HasSubstr("is of the map kitchen"));
  }
  EXPECT_EQ(verify("--least-release 7 --name kitchen").exit_code, kExitDone);
  EXPECT_EQ(sign("--release 1 --name hall --force").exit_code, kExitDone);
  EXPECT_EQ(verify("--name hall").exit_code, kExitDone);
}

TEST_F(SigningTest, OnlyAMapIsSigned) {
  std::ofstream(folder_ / "letter") << "I owe you";
  const Answer answer = runCommand("sign " + (folder_ / "letter") + " --key " + key_ + " --release 1");
  EXPECT_EQ(answer.exit_code, kExitFailure);
  EXPECT_FALSE(fs::exists(folder_ / "letter.sig"));
}

TEST_F(SigningTest, APublicKeyDoesNotSign) {
  const Answer answer = runCommand("sign " + map_ + " --key " + key_ + ".pub --release 9");
  EXPECT_EQ(answer.exit_code, kExitFailure);
  EXPECT_THAT(answer.err, HasSubstr(key_ + ".pub holds a public key"));
  EXPECT_THAT(answer.err, Not(HasSubstr("chmod")));
}

// As a program gives it that keeps secrets.
TEST_F(SigningTest, AKeyMayComeThroughAPipe) {
  const Answer answer = runProgram(
      "bash -c", "'" SPHC_COMMAND " sign " + map_ + " --release 8 --name kitchen --key <(cat " + key_ + ")'");
  EXPECT_EQ(answer.exit_code, kExitDone) << answer.err;
  EXPECT_EQ(verify("--least-release 8").exit_code, kExitDone);
}

// The old key and the new one are trusted while devices are updated.
TEST_F(SigningTest, KeysAreChanged) {
  const std::string both = "--trusted-key " + (folder_ / "other.key.pub");
  EXPECT_EQ(verify(both).exit_code, kExitDone);
  EXPECT_EQ(
      runCommand("sign " + map_ + " --key " + (folder_ / "other.key") + " --release 8 --name kitchen").exit_code,
      kExitDone);
  EXPECT_EQ(verify(both).exit_code, kExitDone);
  EXPECT_THAT(verify().err, HasSubstr("not trusted"));
}

TEST_F(SigningTest, ASecretKeyIsItsOwnersAndNeverReplacedOrTold) {
  std::ifstream in(key_);
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const std::string secret = text.substr(text.size() - 65, 64);
  struct stat facts = {};
  ASSERT_EQ(stat(key_.c_str(), &facts), 0);
  EXPECT_EQ(facts.st_mode & 0777, 0600u);
  EXPECT_EQ(runCommand("key --out " + key_).exit_code, kExitFailure);
  fs::permissions(key_, fs::perms::group_read, fs::perm_options::add);
  for (const std::string &command :
       {"sign " + map_ + " --key " + key_ + " --release 9", "verify " + map_ + " --trusted-key " + key_,
        "sign " + map_ + " --key " + key_ + ".pub --release 9"}) {
    const Answer answer = runCommand(command);
    EXPECT_EQ(answer.exit_code, kExitFailure) << command;
    EXPECT_THAT(answer.out + answer.err, Not(HasSubstr(secret))) << command;
  }
}

TEST_F(SigningTest, ALostPublicKeyIsWrittenAnew) {
  const auto textOf = [](const std::string &path) {
    std::ifstream in(path);
    return std::string{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  };
  const std::string lost = textOf(key_ + ".pub"), anew = "key --public-of " + key_;
  EXPECT_THAT(runCommand(anew).err, HasSubstr("maps.key.pub")) << "one that is there is not replaced";
  fs::remove(key_ + ".pub");
  const Answer answer = runCommand(anew + " --json");
  ASSERT_EQ(answer.exit_code, kExitDone) << answer.err;
  EXPECT_EQ(nlohmann::json::parse(answer.out)["public_key"], key_ + ".pub");
  EXPECT_EQ(textOf(key_ + ".pub"), lost);
  EXPECT_EQ(verify().exit_code, kExitDone);
}

TEST_F(SigningTest, APublicKeyIsOfASecretOneAlone) {
  const std::string encrypting = folder_ / "rooms.key";
  ASSERT_EQ(runCommand("key --for encryption --out " + encrypting).exit_code, kExitDone);
  for (const std::string &file : {key_ + ".pub", encrypting, folder_ / "absent"}) {
    const Answer answer = runCommand("key --public-of " + file);
    EXPECT_EQ(answer.exit_code, kExitFailure) << file;
    EXPECT_THAT(answer.err, HasSubstr("spherecloud key wrote")) << file;
    EXPECT_FALSE(fs::exists(file + ".pub")) << file;
  }
  const Answer nothing = runCommand("key");
  EXPECT_EQ(nothing.exit_code, kExitUsage);
  EXPECT_THAT(nothing.err, HasSubstr("--out or --public-of is required"));
  EXPECT_EQ(runCommand("key --out " + (folder_ / "new.key") + " --public-of " + key_).exit_code, kExitUsage);
}

TEST_F(SigningTest, AReleaseAloneIsNoTrust) {
  EXPECT_EQ(runCommand("inspect " + map_ + " --no-picture --least-release 3").exit_code, kExitUsage);
}

}  // namespace
}  // namespace sphc::host
