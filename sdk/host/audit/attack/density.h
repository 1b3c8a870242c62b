// The geometry-revealing attack on line clouds (Chelani, Kahl, Sattler, "How Privacy-Preserving Are Line Clouds?
// Recovering Scene Details From 3D Lines", CVPR 2021): neighbouring points have neighbouring lines, and where a
// line passes its neighbours closest its point is likely to be.
#pragma once
#include <functional>
#include <vector>

#include "host/audit/attack/line.h"

namespace sphc::host {

struct DensityAttackOptions {
  uint32_t neighbours = 100;  // lines that vote for where a line's point is
  uint32_t rounds = 4;        // after the first: with neighbours by the points found so far
  double peak_share = 0.2;    // of the votes that make a peak
};

// Told after each line of each round.
using AttackProgress = std::function<void(uint64_t done, uint64_t total)>;

// The point of each line.  In the first round a line's neighbours are the lines that pass closest to it; in the
// later ones those whose points lie closest to its own.  Each votes for the point of the line that is nearest to
// it.  The point is where votes are densest: the median of the shortest stretch of the line that holds `peak_share`
// of them (Venter's estimate of a mode, 1967: a histogram whose bins fit themselves).
std::vector<Vector3> attackByDensity(const std::vector<Line> &lines, const DensityAttackOptions &options,
                                     const AttackProgress &progress);

// Where along `line`, metres from its point_m, it passes closest to another; NaN for parallels.
double closestAlong(const Line &line, const Line &other);
// The densest place among votes; NaN without any.
double densestOf(std::vector<double> votes_m, double peak_share);

}  // namespace sphc::host
