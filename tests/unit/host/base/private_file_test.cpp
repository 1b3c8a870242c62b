#include "host/base/private_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace sphc::host {
namespace {

namespace fs = std::filesystem;

TEST(PrivateFile, IsOneThatOnlyItsOwnerReads) {
  const std::string path = (fs::path(testing::TempDir()) / "private_file_test.key").string();
  std::ofstream(path) << "secret";
  fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_NO_THROW(checkPrivate(path, "it opens doors"));
  for (const fs::perms more : {fs::perms::group_read, fs::perms::others_read, fs::perms::group_write}) {
    fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write | more);
    try {
      checkPrivate(path, "it opens doors");
      ADD_FAILURE() << "others may read it";
    } catch (const std::runtime_error &error) {
      EXPECT_EQ(std::string(error.what()),
                "key file " + path + ": others may read it, and it opens doors; run: chmod 600 " + path);
    }
  }
  fs::remove(path);
  EXPECT_NO_THROW(checkPrivate(path, "it opens doors"));
  EXPECT_THROW(checkPrivate(testing::TempDir(), "it opens doors"), std::runtime_error);
}

}  // namespace
}  // namespace sphc::host
