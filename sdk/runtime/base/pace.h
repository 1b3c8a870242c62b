// How fast work of one kind goes on this device, learnt from what was timed: what fits before a deadline?
#pragma once
#include "runtime/base/deadline.h"

namespace sphc {

class Pace {
 public:
  // Until something was timed.
  explicit Pace(double guessed_ns) : unit_ns_(guessed_ns) {}

  double unitNs() const { return unit_ns_; }
  // How many units fit?  `most` without a deadline.
  double fitting(const Deadline &deadline, double most) const {
    if (!deadline.isSet()) return most;
    const double fitting = static_cast<double>(deadline.leftNs()) / unit_ns_;
    return fitting < most ? fitting : most;
  }
  // Slow at most by half a time: a frame may have been interrupted by other work of the device.
  void learn(double units, uint64_t elapsed_ns) {
    if (!(units > 0)) return;
    const double now_ns = static_cast<double>(elapsed_ns) / units + kLeastNs, most_ns = 1.5 * unit_ns_;
    if (!timed_) {
      unit_ns_ = now_ns;
    } else if (now_ns > unit_ns_) {
      unit_ns_ = now_ns < most_ns ? now_ns : most_ns;
    } else {
      unit_ns_ += 0.25 * (now_ns - unit_ns_);
    }
    timed_ = true;
  }

 private:
  static constexpr double kLeastNs = 1e-3;  // a clock that stands measures nothing

  double unit_ns_;
  bool timed_ = false;
};

}  // namespace sphc
