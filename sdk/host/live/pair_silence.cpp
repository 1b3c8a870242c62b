#include "host/live/pair_silence.h"

namespace sphc::host {

std::string unpairedText(const sphc_pairer_counts &counts) {
  return "Without a partner: " + std::to_string(counts.too_far + counts.overtaken + counts.full + counts.ended) +
         "; never came: " + std::to_string(counts.color_lost) + " colour, " + std::to_string(counts.depth_lost) +
         " depth";
}

std::string PairSilence::hear(Rig::Got got, const Rig &rig, Clock::time_point now) {
  if (got == Rig::Got::kPair) {
    last_pair_ = now;
    const bool was_told = is_told_;
    is_told_ = false;
    return was_told ? "Pairs of images come again." : "";
  }
  if (is_told_ || now - last_pair_ < kLong) return "";
  is_told_ = true;
  const std::string troubles = rig.troubles();
  return "No pair of images has come for " + std::to_string(kLong.count()) + " s. " + unpairedText(rig.counts()) +
         (troubles.empty() ? "" : "; " + troubles);
}

}  // namespace sphc::host
