// Ten frames a second are enough to guide by.
#pragma once
#include <cstdint>

namespace sphc::host {

class LookPace {
 public:
  // Is the frame of this time to be looked at, after those that were?
  bool isDue(int64_t time_ns) const { return !has_last_ || time_ns - last_ns_ >= kPeriodNs; }
  void looked(int64_t time_ns) {
    has_last_ = true;
    last_ns_ = time_ns;
  }

 private:
  static constexpr int64_t kPeriodNs = 90000000;  // less than 100 ms, so that times may jitter
  bool has_last_ = false;
  int64_t last_ns_ = 0;
};

}  // namespace sphc::host
