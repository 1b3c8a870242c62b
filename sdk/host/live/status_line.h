// One line that is written over again and again on a terminal; silent elsewhere.
#pragma once
#include <chrono>
#include <string>

namespace sphc::host {

class StatusLine {
 public:
  StatusLine();
  ~StatusLine();  // wipes the line
  StatusLine(const StatusLine &) = delete;
  StatusLine &operator=(const StatusLine &) = delete;

  // At most ten times a second.
  void show(const std::string &text);
  // Before other words on the terminal.
  void wipe();

 private:
  using Clock = std::chrono::steady_clock;

  bool terminal_, drawn_ = false;
  Clock::time_point last_;
};

}  // namespace sphc::host
