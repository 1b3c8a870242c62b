#include "host/base/write_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <iterator>

#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"

namespace sphc::host {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class WriteFileTest : public testing::Test {
 protected:
  static mode_t modeOf(const std::string &path) {
    struct stat facts = {};
    return stat(path.c_str(), &facts) == 0 ? facts.st_mode & 0777 : 0;
  }
  size_t entries() const {
    return static_cast<size_t>(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()));
  }
  static std::string refusal(const std::string &path, const std::string &text) {
    return test::refusal([&] { writeFile(path, text); });
  }

  const test::TempFolder folder_;
};

TEST_F(WriteFileTest, ReplacesWholeAndLeavesNothingBeside) {
  writeFile(folder_ / "a", std::string("long before"));
  writeFile(folder_ / "a", std::vector<uint8_t>{'n', 'o', 'w'});
  EXPECT_EQ(folder_.read("a"), "now");
  EXPECT_EQ(entries(), 1u);
}

// A limit on the size of files fails in the middle of writing, as a full disk does.
TEST_F(WriteFileTest, AFailureLeavesTheOldFileAndNothingBeside) {
  writeFile(folder_ / "a", std::string("precious"));
  rlimit before = {};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit little = before;
  little.rlim_cur = 4096;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &little), 0);
  const std::string told = refusal(folder_ / "a", std::string(100000, 'x'));
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_THAT(told, HasSubstr(folder_ / "a"));
  EXPECT_THAT(told, HasSubstr("disk not full"));
  EXPECT_EQ(folder_.read("a"), "precious");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(WriteFileTest, WhatIsPrivateIsSoFromTheFirstByteOn) {
  for (const mode_t mask : {mode_t{0}, mode_t{0277}}) {
    const mode_t before = umask(mask);
    const std::string path = folder_ / ("note" + std::to_string(mask));
    writeFile(path, std::string("secret"), Readers::kOwner);
    umask(before);
    EXPECT_EQ(modeOf(path), 0600u);
  }
  fs::permissions(folder_ / "note0", fs::perms(0644));
  writeFile(folder_ / "note0", std::string("secret"), Readers::kOwner);
  EXPECT_EQ(modeOf(folder_ / "note0"), 0600u);
}

TEST_F(WriteFileTest, OtherFilesKeepTheModeTheyHad) {
  const mode_t before = umask(022);
  writeFile(folder_ / "a", std::string("1"));
  umask(before);
  EXPECT_EQ(modeOf(folder_ / "a"), 0644u);
  fs::permissions(folder_ / "a", fs::perms(0640));
  writeFile(folder_ / "a", std::string("2"));
  EXPECT_EQ(modeOf(folder_ / "a"), 0640u);
}

TEST_F(WriteFileTest, ALinkKeepsPointingToItsFile) {
  writeFile(folder_ / "file", std::string("1"));
  fs::create_symlink("file", folder_ / "link");
  writeFile(folder_ / "link", std::string("2"));
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_EQ(folder_.read("file"), "2");
}

TEST_F(WriteFileTest, DevicesAreWrittenInto) {
  writeFile("/dev/null", std::string("gone"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_THAT(refusal("/dev/full", "no room"), HasSubstr("/dev/full: No space left"));
}

TEST_F(WriteFileTest, AFolderThatIsNotThereIsNamed) {
  EXPECT_THAT(refusal(folder_ / "none/a", "x"), HasSubstr("none/a: No such file"));
  EXPECT_THAT(refusal(folder_.path(), "x"), HasSubstr(folder_.path().string()));
  EXPECT_EQ(entries(), 0u);
}

TEST_F(WriteFileTest, ANewFileTakesNobodysPlaceAndLeavesNothing) {
  writeNewFile(folder_ / "key", "first", Readers::kOwner);
  EXPECT_EQ(modeOf(folder_ / "key"), 0600u);
  EXPECT_THAT(test::refusal([&] { writeNewFile(folder_ / "key", "second", Readers::kOwner); }),
              HasSubstr("something has taken its name"));
  EXPECT_THROW(writeNewFile(folder_ / "absent/key", "third"), std::runtime_error);
  EXPECT_EQ(folder_.read("key"), "first");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(WriteFileTest, ANewNameTakesNobodysPlace) {
  writeFile(folder_ / "a", std::string("old"));
  writeFile(folder_ / "b", std::string("new"));
  EXPECT_THROW(renameToNew(folder_ / "b", folder_ / "a"), std::runtime_error);
  EXPECT_EQ(folder_.read("a"), "old");
  EXPECT_EQ(folder_.read("b"), "new");
  renameToNew(folder_ / "b", folder_ / "c");
  EXPECT_EQ(folder_.read("c"), "new");
  EXPECT_FALSE(fs::exists(folder_ / "b"));
}

}  // namespace
}  // namespace sphc::host
