#include "host/mapping/told_pieces.h"

#include <algorithm>

#include "host/base/median.h"

namespace sphc::host {
namespace {

// A pause is longer than both: this, and so many times the usual step from pose to pose.
constexpr double kLeastPauseNs = 0.5e9, kUsualSteps = 3;

// Without overflow, whatever the times are.
uint64_t between(const recording::TimedPose &early, const recording::TimedPose &late) {
  return static_cast<uint64_t>(late.time_ns) - static_cast<uint64_t>(early.time_ns);
}

}  // namespace

ToldPieces::ToldPieces(const std::vector<recording::TimedPose> &poses) {
  std::vector<double> gaps_ns;
  for (size_t i = 1; i < poses.size(); ++i) gaps_ns.push_back(static_cast<double>(between(poses[i - 1], poses[i])));
  const double longest_ns = std::max(kLeastPauseNs, kUsualSteps * median(gaps_ns));
  for (size_t i = 1; i < poses.size(); ++i)
    if (gaps_ns[i - 1] > longest_ns)
      pauses_ns_.push_back(poses[i - 1].time_ns + static_cast<int64_t>(between(poses[i - 1], poses[i]) / 2));
}

uint32_t ToldPieces::at(int64_t time_ns) const {
  return static_cast<uint32_t>(std::upper_bound(pauses_ns_.begin(), pauses_ns_.end(), time_ns) -
                               pauses_ns_.begin());
}

}  // namespace sphc::host
