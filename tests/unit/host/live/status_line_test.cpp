#include "host/live/status_line.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace sphc::host {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

// A terminal in the place of stderr.
class StatusLineTest : public testing::Test {
 protected:
  StatusLineTest() : kept_(dup(STDERR_FILENO)), terminal_(posix_openpt(O_RDWR | O_NOCTTY)) {
    if (grantpt(terminal_) != 0 || unlockpt(terminal_) != 0) return;
    const int inner = open(ptsname(terminal_), O_RDWR | O_NOCTTY);
    is_ready_ = inner >= 0 && dup2(inner, STDERR_FILENO) >= 0;
    close(inner);
  }
  ~StatusLineTest() override {
    dup2(kept_, STDERR_FILENO);
    close(kept_);
    close(terminal_);
  }

  static void setColumns(unsigned short columns) {
    const winsize size = {24, columns, 0, 0};
    ASSERT_EQ(ioctl(STDERR_FILENO, TIOCSWINSZ, &size), 0);
  }
  std::string shown(const std::string &text) const {
    StatusLine line;
    line.show(text);
    char read_back[1000];
    const ssize_t bytes = read(terminal_, read_back, sizeof read_back);
    return std::string(read_back, bytes > 0 ? static_cast<size_t>(bytes) : 0);
  }

  int kept_, terminal_;
  bool is_ready_ = false;
};

TEST_F(StatusLineTest, FitsTheTerminal) {
  if (!is_ready_) GTEST_SKIP() << "no terminals here";
  setColumns(40);
  EXPECT_THAT(shown(std::string(39, 'a') + std::string(60, 'b')), EndsWith("\x1b[K" + std::string(39, 'a')));
}

TEST_F(StatusLineTest, CutsNoCharacterInTwo) {
  if (!is_ready_) GTEST_SKIP() << "no terminals here";
  setColumns(5);
  EXPECT_THAT(shown("Hügelland"), EndsWith("\x1b[KHüge"));
}

TEST_F(StatusLineTest, OfUnknownWidthStillShowsTheLine) {
  if (!is_ready_) GTEST_SKIP() << "no terminals here";
  setColumns(0);
  EXPECT_THAT(shown(std::string(120, 'a')), HasSubstr(std::string(120, 'a')));
}

}  // namespace
}  // namespace sphc::host
