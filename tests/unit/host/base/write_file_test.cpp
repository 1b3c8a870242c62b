#include "host/base/write_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace sphc::host {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class WriteFileTest : public testing::Test {
 protected:
  WriteFileTest() {
    char path[] = "/tmp/sphc_write_XXXXXX";
    if (mkdtemp(path)) folder_ = path;
  }
  ~WriteFileTest() override { fs::remove_all(folder_); }

  std::string operator/(const std::string &name) const { return folder_ + "/" + name; }
  static std::string textOf(const std::string &path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }
  static mode_t modeOf(const std::string &path) {
    struct stat facts = {};
    return stat(path.c_str(), &facts) == 0 ? facts.st_mode & 0777 : 0;
  }
  size_t entries() const {
    return static_cast<size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
  static std::string refusal(const std::string &path, const std::string &text) {
    try {
      writeFile(path, text);
    } catch (const std::runtime_error &error) {
      return error.what();
    }
    return "written";
  }

  std::string folder_;
};

TEST_F(WriteFileTest, ReplacesWholeAndLeavesNothingBeside) {
  writeFile(*this / "a", std::string("long before"));
  writeFile(*this / "a", std::vector<uint8_t>{'n', 'o', 'w'});
  EXPECT_EQ(textOf(*this / "a"), "now");
  EXPECT_EQ(entries(), 1u);
}

// A limit on the size of files fails in the middle of writing, as a full disk does.
TEST_F(WriteFileTest, AFailureLeavesTheOldFileAndNothingBeside) {
  writeFile(*this / "a", std::string("precious"));
  rlimit before = {};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit little = before;
  little.rlim_cur = 4096;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &little), 0);
  const std::string told = refusal(*this / "a", std::string(100000, 'x'));
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_THAT(told, HasSubstr(*this / "a"));
  EXPECT_THAT(told, HasSubstr("disk not full"));
  EXPECT_EQ(textOf(*this / "a"), "precious");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(WriteFileTest, WhatIsPrivateIsSoFromTheFirstByteOn) {
  for (const mode_t mask : {mode_t{0}, mode_t{0277}}) {
    const mode_t before = umask(mask);
    const std::string path = *this / ("note" + std::to_string(mask));
    writeFile(path, std::string("secret"), Readers::kOwner);
    umask(before);
    EXPECT_EQ(modeOf(path), 0600u);
  }
  fs::permissions(*this / "note0", fs::perms(0644));
  writeFile(*this / "note0", std::string("secret"), Readers::kOwner);
  EXPECT_EQ(modeOf(*this / "note0"), 0600u);
}

TEST_F(WriteFileTest, OtherFilesKeepTheModeTheyHad) {
  const mode_t before = umask(022);
  writeFile(*this / "a", std::string("1"));
  umask(before);
  EXPECT_EQ(modeOf(*this / "a"), 0644u);
  fs::permissions(*this / "a", fs::perms(0640));
  writeFile(*this / "a", std::string("2"));
  EXPECT_EQ(modeOf(*this / "a"), 0640u);
}

TEST_F(WriteFileTest, ALinkKeepsPointingToItsFile) {
  writeFile(*this / "file", std::string("1"));
  fs::create_symlink("file", *this / "link");
  writeFile(*this / "link", std::string("2"));
  EXPECT_TRUE(fs::is_symlink(*this / "link"));
  EXPECT_EQ(textOf(*this / "file"), "2");
}

TEST_F(WriteFileTest, DevicesAreWrittenInto) {
  writeFile("/dev/null", std::string("gone"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_THAT(refusal("/dev/full", "no room"), HasSubstr("/dev/full: No space left"));
}

TEST_F(WriteFileTest, AFolderThatIsNotThereIsNamed) {
  EXPECT_THAT(refusal(*this / "none/a", "x"), HasSubstr("none/a: No such file"));
  EXPECT_THAT(refusal(folder_, "x"), HasSubstr(folder_));
  EXPECT_EQ(entries(), 0u);
}

TEST_F(WriteFileTest, ANewFileTakesNobodysPlaceAndLeavesNothing) {
  writeNewFile(*this / "key", "first", Readers::kOwner);
  EXPECT_EQ(modeOf(*this / "key"), 0600u);
  try {
    writeNewFile(*this / "key", "second", Readers::kOwner);
    ADD_FAILURE() << "it was replaced";
  } catch (const std::runtime_error &error) {
    EXPECT_THAT(error.what(), HasSubstr("something has taken its name"));
  }
  EXPECT_THROW(writeNewFile(*this / "absent/key", "third"), std::runtime_error);
  EXPECT_EQ(textOf(*this / "key"), "first");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(WriteFileTest, ANewNameTakesNobodysPlace) {
  writeFile(*this / "a", std::string("old"));
  writeFile(*this / "b", std::string("new"));
  EXPECT_THROW(renameToNew(*this / "b", *this / "a"), std::runtime_error);
  EXPECT_EQ(textOf(*this / "a"), "old");
  EXPECT_EQ(textOf(*this / "b"), "new");
  renameToNew(*this / "b", *this / "c");
  EXPECT_EQ(textOf(*this / "c"), "new");
  EXPECT_FALSE(fs::exists(*this / "b"));
}

}  // namespace
}  // namespace sphc::host
