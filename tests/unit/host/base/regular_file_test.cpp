#include "host/base/regular_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "tests/support/nobody.h"

namespace sphc::host {
namespace {

namespace fs = std::filesystem;

std::string refusal(const std::string &path) {
  try {
    checkIsFile(path, "the map itself");
  } catch (const std::runtime_error &error) {
    return error.what();
  }
  return "";
}

TEST(RegularFile, IsWhatIsReadToItsEnd) {
  const std::string path = (fs::path(testing::TempDir()) / "regular_file_test").string();
  fs::remove(path);
  EXPECT_EQ(refusal(path), "") << "nothing is there";
  std::ofstream(path) << "a map";
  EXPECT_EQ(refusal(path), "");
  fs::remove(path);
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  EXPECT_EQ(refusal(path), path + " is a device or a pipe; give the map itself");
  fs::remove(path);
  EXPECT_EQ(refusal("/dev/zero"), "/dev/zero is a device or a pipe; give the map itself");
  EXPECT_EQ(refusal(testing::TempDir()), testing::TempDir() + " is a folder; give the map itself");
}

TEST(RegularFile, ThatMayNotBeReadIsNamedWithTheCause) {
  const std::string path = (fs::path(testing::TempDir()) / "unreadable_file_test").string();
  std::ofstream(path) << "a map";
  fs::permissions(path, fs::perms::none);
  {
    const test::Nobody nobody;
    EXPECT_EQ(refusal(path), path + ": Permission denied; check its permissions and those of its folders");
  }
  fs::remove(path);
}

}  // namespace
}  // namespace sphc::host
