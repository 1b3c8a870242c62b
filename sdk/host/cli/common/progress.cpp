#include "host/cli/common/progress.h"

#include <unistd.h>

#include <cstdio>
#include <utility>

#include "host/base/terminal_text.h"

namespace sphc::host {
namespace {

constexpr uint32_t kCells = 28;
constexpr std::chrono::milliseconds kRedraw(80);

std::string clockText(double seconds) {
  char text[32];
  const int whole = static_cast<int>(seconds + 0.5);
  std::snprintf(text, sizeof text, "%d:%02d", whole / 60, whole % 60);
  return text;
}

}  // namespace

ProgressBar::ProgressBar(std::string what)
    : what_(std::move(what)),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(Clock::now()),
      last_(start_ - kRedraw) {}

ProgressBar::~ProgressBar() {
  if (drawn_) std::fputs("\r\033[K", stderr);
}

void ProgressBar::show(uint32_t done, uint32_t total) {
  const auto now = Clock::now();
  if (!terminal_ || total == 0 || (now - last_ < kRedraw && done < total)) return;
  last_ = now;
  drawn_ = true;
  std::string bar;
  for (uint32_t i = 0; i < kCells; ++i) bar += i * uint64_t{total} < uint64_t{done} * kCells ? "█" : "░";
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const std::string left = done > 0 ? clockText(elapsed * (total - done) / done) + " left" : "";
  const std::string line =
      what_ + " " + bar + " " + std::to_string(done) + "/" + std::to_string(total) + "  " + left;
  std::fprintf(stderr, "\r\033[K%s", fitting(line, shownColumns()).c_str());  // wrapped, it would stay
  std::fflush(stderr);
}

}  // namespace sphc::host
