// Maps are encrypted and decrypted by the command.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "command_runner.h"
#include "host/cli/common/exit_code.h"
#include "tests/support/temp_folder.h"
#include "tests/unit/host/tiny_map.h"

namespace sphc::host {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string bytesOf(const std::string &path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

class EncryptionCommandTest : public testing::Test {
 protected:
  EncryptionCommandTest() : map_(folder_ / "room.sphc"), key_(folder_ / "rooms.key") {
    writeTinyMap(map_, 40);
    EXPECT_EQ(runCommand("key --for encryption --out " + key_).exit_code, kExitDone);
    EXPECT_EQ(runCommand("encrypt " + map_ + " --key " + key_).exit_code, kExitDone);
  }
  Answer decrypt(const std::string &key) const {
    return runCommand("decrypt " + map_ + ".enc --key " + key + " --out " + (folder_ / "again.sphc"));
  }

  test::TempFolder folder_;
  std::string map_, key_;
};

TEST_F(EncryptionCommandTest, AMapComesBackAsItWas) {
  EXPECT_THAT(bytesOf(map_ + ".enc"), Not(HasSubstr(bytesOf(map_).substr(64, 32))));
  ASSERT_EQ(decrypt(key_).exit_code, kExitDone);
  EXPECT_EQ(bytesOf(folder_ / "again.sphc"), bytesOf(map_));
  EXPECT_EQ(decrypt(key_).exit_code, kExitFailure) << "a map that is there stays";
  EXPECT_EQ(runCommand("encrypt " + map_ + " --key " + key_).exit_code, kExitDone)
      << "an encrypted one is replaced";
}

TEST_F(EncryptionCommandTest, RefusalsHaveACause) {
  const std::string other = folder_ / "other.key";
  ASSERT_EQ(runCommand("key --for encryption --out " + other).exit_code, kExitDone);
  EXPECT_THAT(decrypt(other).err, HasSubstr("another key"));
  EXPECT_THAT(runCommand("inspect --no-picture " + map_ + ".enc").err, HasSubstr("spherecloud decrypt"));
  EXPECT_EQ(runCommand("encrypt " + map_ + ".enc --key " + key_).exit_code, kExitFailure) << "it is no map";
  std::ofstream(map_ + ".enc", std::ios::app) << 'x';
  EXPECT_THAT(decrypt(key_).err, HasSubstr("was cut or something was added"));
  EXPECT_FALSE(std::ifstream(folder_ / "again.sphc").good());
}

TEST_F(EncryptionCommandTest, AKeyIsItsOwnersAndNeverReplacedOrTold) {
  const std::string text = bytesOf(key_), secret = text.substr(text.size() - 65, 64);
  struct stat facts = {};
  ASSERT_EQ(stat(key_.c_str(), &facts), 0);
  EXPECT_EQ(facts.st_mode & 0777, 0600u);
  const std::string signing = folder_ / "maps.key";
  ASSERT_EQ(runCommand("key --out " + signing).exit_code, kExitDone);
  for (const std::string &command :
       {"key --for encryption --out " + key_, "sign " + map_ + " --key " + key_ + " --release 1",
        "encrypt " + map_ + " --key " + signing}) {
    const Answer answer = runCommand(command);
    EXPECT_EQ(answer.exit_code, kExitFailure) << command;
    EXPECT_THAT(answer.out + answer.err, Not(HasSubstr(secret))) << command;
  }
  EXPECT_EQ(bytesOf(key_), text);
}

}  // namespace
}  // namespace sphc::host
