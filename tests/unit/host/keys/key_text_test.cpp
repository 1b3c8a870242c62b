#include "host/keys/key_text.h"

#include <gtest/gtest.h>

#include "tests/support/temp_folder.h"

namespace sphc::host {
namespace {

TEST(KeyText, HasTwoLines) {
  const test::TempFolder folder;
  const std::string path = folder / "a.key";
  KeyBytes key;
  key.fill(0xab);
  writeKeyText(path, "what for", key.data(), Readers::kOwner);
  std::string digits;
  for (size_t i = 0; i < key.size(); ++i) digits += "ab";
  EXPECT_EQ(folder.read("a.key"), "what for\n" + digits + "\n");
  KeyBytes read = {};
  EXPECT_FALSE(readKeyText(path, "another purpose", &read));
  EXPECT_TRUE(readKeyText(path, "what for", &read));
  EXPECT_EQ(read, key);
  wipe(&read);
  EXPECT_EQ(read, KeyBytes{});
}

TEST(DrawKey, TwoDiffer) { EXPECT_NE(drawKey(), drawKey()); }

}  // namespace
}  // namespace sphc::host
