// How often something happens, over the last second or so.
#pragma once
#include <chrono>

namespace sphc::host {

class Rate {
 public:
  void count() {
    const Clock::time_point now = Clock::now();
    const double gap_s = std::chrono::duration<double>(now - last_).count();
    if (counted_) period_s_ += (period_s_ > 0 ? 0.05 : 1.0) * (gap_s - period_s_);
    counted_ = true;
    last_ = now;
  }
  // 0 until it happened twice, and once it stopped.
  double hz() const {
    const double silent_s = std::chrono::duration<double>(Clock::now() - last_).count();
    return period_s_ > 0 && silent_s < 1 + 3 * period_s_ ? 1 / period_s_ : 0;
  }

 private:
  using Clock = std::chrono::steady_clock;
  bool counted_ = false;
  double period_s_ = 0;
  Clock::time_point last_;
};

}  // namespace sphc::host
