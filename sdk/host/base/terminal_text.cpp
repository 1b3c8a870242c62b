#include "host/base/terminal_text.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>

namespace sphc::host {
namespace {

constexpr size_t kMostShown = 150;

bool beginsCharacter(char byte) { return (static_cast<unsigned char>(byte) & 0xc0) != 0x80; }

}  // namespace

size_t columnsOf(const std::string &text) {
  return static_cast<size_t>(std::count_if(text.begin(), text.end(), beginsCharacter));
}

std::string fitting(const std::string &text, size_t columns) {
  size_t bytes = 0;
  for (; bytes < text.size(); ++bytes)
    if (beginsCharacter(text[bytes]) && columns-- == 0) break;
  return text.substr(0, bytes);
}

size_t shownColumns() {
  winsize size = {};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kMostShown;
  return std::min<size_t>(kMostShown, size.ws_col > 1 ? size.ws_col - 1u : 1);
}

}  // namespace sphc::host
