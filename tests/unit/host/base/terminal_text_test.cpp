#include "host/base/terminal_text.h"

#include <gtest/gtest.h>

namespace sphc::host {
namespace {

TEST(TerminalText, CountsCharacters) {
  EXPECT_EQ(columnsOf(""), 0u);
  EXPECT_EQ(columnsOf("room"), 4u);
  EXPECT_EQ(columnsOf("Küche █"), 7u);
}

TEST(TerminalText, CutsNoCharacterInTwo) {
  EXPECT_EQ(fitting("Küche", 1), "K");
  EXPECT_EQ(fitting("Küche", 2), "Kü");
  EXPECT_EQ(fitting("Küche", 5), "Küche");
  EXPECT_EQ(fitting("Küche", 9), "Küche");
  EXPECT_EQ(fitting("Küche", 0), "");
}

}  // namespace
}  // namespace sphc::host
