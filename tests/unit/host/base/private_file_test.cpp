#include "host/base/private_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"

namespace sphc::host {
namespace {

namespace fs = std::filesystem;

TEST(PrivateFile, IsOneThatOnlyItsOwnerReads) {
  const test::TempFolder folder;
  const std::string path = folder.write("private.key", "secret");
  fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_NO_THROW(checkPrivate(path, "it opens doors"));
  for (const fs::perms more : {fs::perms::group_read, fs::perms::others_read, fs::perms::group_write}) {
    fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write | more);
    EXPECT_EQ(test::refusal([&] { checkPrivate(path, "it opens doors"); }),
              "key file " + path + ": others may read it, and it opens doors; run: chmod 600 " + path);
  }
  fs::remove(path);
  EXPECT_NO_THROW(checkPrivate(path, "it opens doors"));
}

std::string whyNoKey(const std::string &path) {
  char bytes[8];
  try {
    return readPrivate(path, bytes, sizeof bytes) ? "read" : "not there";
  } catch (const std::runtime_error &error) {
    return error.what();
  }
}

TEST(PrivateFile, IsReadWithoutWaiting) {
  const test::TempFolder folder;
  const std::string path = folder / "pipe";
  EXPECT_EQ(whyNoKey(path), "not there");
  char bytes[4];
  std::ofstream(path) << "sec";
  EXPECT_EQ(readPrivate(path, bytes, sizeof bytes), 3u);
  std::ofstream(path) << "secret";
  EXPECT_EQ(readPrivate(path, bytes, sizeof bytes), 4u);
  EXPECT_EQ(std::string(bytes, 4), "secr");
  fs::remove(path);
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  EXPECT_EQ(whyNoKey(path), "key file " + path + " is a pipe into which nobody writes; give the file itself");
  EXPECT_EQ(whyNoKey("/dev/zero"), "key file /dev/zero is a device; give the file itself");
  EXPECT_EQ(whyNoKey(folder.path()), "key file " + folder.path().string() + " is a folder; give the file itself");
}

// What is written later is waited for.
TEST(PrivateFile, MayBeAPipe) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  std::thread writer([&ends] {
    for (const char byte : {'a', 'b', 'c'}) EXPECT_EQ(write(ends[1], &byte, 1), 1);
    close(ends[1]);
  });
  char bytes[8];
  EXPECT_EQ(readPrivate("/dev/fd/" + std::to_string(ends[0]), bytes, sizeof bytes), 3u);
  EXPECT_EQ(std::string(bytes, 3), "abc");
  writer.join();
  close(ends[0]);
}

}  // namespace
}  // namespace sphc::host
