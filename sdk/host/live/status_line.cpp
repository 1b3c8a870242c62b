#include "host/live/status_line.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace sphc::host {
namespace {

constexpr int kMostShown = 150;

// What does not fit would wrap, and could not be wiped.  Not the last column: some terminals wrap there already.
int shownBytes() {
  winsize size = {};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kMostShown;
  return std::min(kMostShown, std::max(1, size.ws_col - 1));
}

}  // namespace

StatusLine::StatusLine() : terminal_(isatty(STDERR_FILENO) != 0) {}
StatusLine::~StatusLine() { wipe(); }

void StatusLine::show(const std::string &text) {
  if (!terminal_ || Clock::now() - last_ < std::chrono::milliseconds(100)) return;
  last_ = Clock::now();
  drawn_ = true;
  std::fprintf(stderr, "\r\x1b[K%.*s", shownBytes(), text.c_str());
  std::fflush(stderr);
}

void StatusLine::wipe() {
  if (drawn_) std::fputs("\r\x1b[K", stderr);
  drawn_ = false;
}

}  // namespace sphc::host
