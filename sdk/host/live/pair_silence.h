// Says where pairs of images stay away, and that they come again: a status line is seen on a terminal alone.
#pragma once
#include "host/live/rig.h"

namespace sphc::host {

// "Without a partner: 12; never came: 0 colour, 3 depth"
std::string unpairedText(const sphc_pairer_counts &counts);

class PairSilence {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds kLong{5};

  explicit PairSilence(Clock::time_point now = Clock::now()) : last_pair_(now) {}
  // Of each answer of rig.next: what is to be said now, mostly nothing.
  std::string hear(Rig::Got got, const Rig &rig, Clock::time_point now = Clock::now());

 private:
  Clock::time_point last_pair_;
  bool is_told_ = false;
};

}  // namespace sphc::host
