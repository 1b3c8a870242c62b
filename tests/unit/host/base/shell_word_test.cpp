#include "host/base/shell_word.h"

#include <gtest/gtest.h>

namespace sphc::host {
namespace {

TEST(ShellWord, QuotesWhatAShellWouldTakeApart) {
  EXPECT_EQ(shellWord("walks/room-2.mcap"), "walks/room-2.mcap");
  EXPECT_EQ(shellWord("my walk"), "'my walk'");
  EXPECT_EQ(shellWord("it's $HOME;"), "'it'\\''s $HOME;'");
  EXPECT_EQ(shellWord(""), "''");
}

}  // namespace
}  // namespace sphc::host
