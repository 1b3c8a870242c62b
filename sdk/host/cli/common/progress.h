// A progress bar on stderr when that is a terminal; silent elsewhere.
#pragma once
#include <chrono>
#include <cstdint>
#include <string>

namespace sphc::host {

class ProgressBar {
 public:
  explicit ProgressBar(std::string what);
  ProgressBar(const ProgressBar &) = delete;
  ProgressBar &operator=(const ProgressBar &) = delete;
  ~ProgressBar();  // wipes the line

  void show(uint32_t done, uint32_t total);

 private:
  using Clock = std::chrono::steady_clock;

  std::string what_;
  bool terminal_;
  bool drawn_ = false;
  Clock::time_point start_, last_;
};

}  // namespace sphc::host
