// How well a score tells positives from negatives.
#pragma once
#include <vector>

namespace sphc::host {

struct Auc {
  double value;  // probability that a positive scores higher than a negative, ties count half; 0.5: no idea
  double standard_error;  // Hanley and McNeil 1982
  double chance_error;    // of scores that tell nothing, with the ties that these have (Mann and Whitney 1947)
};

// 0.5 when there are no positives or no negatives.
Auc areaUnderCurve(const std::vector<double> &scores, const std::vector<bool> &positive);

}  // namespace sphc::host
