#include "host/live/status_line.h"

#include <unistd.h>

#include <cstdio>

namespace sphc::host {

StatusLine::StatusLine() : terminal_(isatty(STDERR_FILENO) != 0) {}
StatusLine::~StatusLine() { wipe(); }

void StatusLine::show(const std::string &text) {
  if (!terminal_ || Clock::now() - last_ < std::chrono::milliseconds(100)) return;
  last_ = Clock::now();
  drawn_ = true;
  std::fprintf(stderr, "\r\x1b[K%.*s", 150, text.c_str());
  std::fflush(stderr);
}

void StatusLine::wipe() {
  if (drawn_) std::fputs("\r\x1b[K", stderr);
  drawn_ = false;
}

}  // namespace sphc::host
