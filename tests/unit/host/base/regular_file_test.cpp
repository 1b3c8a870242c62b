#include "host/base/regular_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "tests/support/nobody.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"

namespace sphc::host {
namespace {

namespace fs = std::filesystem;

std::string refusal(const std::string &path) {
  return test::refusal([&] { checkIsFile(path, "the map itself"); });
}

TEST(RegularFile, IsWhatIsReadToItsEnd) {
  const test::TempFolder folder;
  const std::string path = folder / "map";
  EXPECT_EQ(refusal(path), "") << "nothing is there";
  std::ofstream(path) << "a map";
  EXPECT_EQ(refusal(path), "");
  fs::remove(path);
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  EXPECT_EQ(refusal(path), path + " is a device or a pipe; give the map itself");
  EXPECT_EQ(refusal("/dev/zero"), "/dev/zero is a device or a pipe; give the map itself");
  EXPECT_EQ(refusal(folder.path()), folder.path().string() + " is a folder; give the map itself");
}

TEST(RegularFile, ThatMayNotBeReadIsNamedWithTheCause) {
  const test::TempFolder folder;
  fs::permissions(folder.path(), fs::perms::all);  // somebody else comes as far as the file
  const std::string path = folder.write("map", "a map");
  fs::permissions(path, fs::perms::none);
  const test::Nobody nobody;
  EXPECT_EQ(refusal(path), path + ": Permission denied; check its permissions and those of its folders");
}

}  // namespace
}  // namespace sphc::host
