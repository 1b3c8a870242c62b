#include "host/live/status_line.h"

#include <unistd.h>

#include <cstdio>

#include "host/base/terminal_text.h"

namespace sphc::host {

StatusLine::StatusLine() : terminal_(isatty(STDERR_FILENO) != 0) {}
StatusLine::~StatusLine() { wipe(); }

void StatusLine::show(const std::string &text) {
  if (!terminal_ || Clock::now() - last_ < std::chrono::milliseconds(100)) return;
  last_ = Clock::now();
  drawn_ = true;
  // What does not fit would wrap, and could not be wiped.
  std::fprintf(stderr, "\r\x1b[K%s", fitting(text, shownColumns()).c_str());
  std::fflush(stderr);
}

void StatusLine::wipe() {
  if (drawn_) std::fputs("\r\x1b[K", stderr);
  drawn_ = false;
}

}  // namespace sphc::host
