#include "host/keys/key_text.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace sphc::host {
namespace {

class KeyTextTest : public testing::Test {
 protected:
  KeyTextTest() : path_((std::filesystem::path(testing::TempDir()) / "key_text_test").string()) {}
  ~KeyTextTest() override { std::filesystem::remove(path_); }
  std::string path_;
};

TEST_F(KeyTextTest, HasTwoLines) {
  KeyBytes key;
  key.fill(0xab);
  writeKeyText(path_, "what for", key.data(), Readers::kOwner);
  std::ifstream in(path_);
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  std::string digits;
  for (size_t i = 0; i < key.size(); ++i) digits += "ab";
  EXPECT_EQ(text, "what for\n" + digits + "\n");
  KeyBytes read = {};
  EXPECT_FALSE(readKeyText(path_, "another purpose", &read));
  EXPECT_TRUE(readKeyText(path_, "what for", &read));
  EXPECT_EQ(read, key);
  wipe(&read);
  EXPECT_EQ(read, KeyBytes{});
}

TEST(DrawKey, TwoDiffer) { EXPECT_NE(drawKey(), drawKey()); }

}  // namespace
}  // namespace sphc::host
