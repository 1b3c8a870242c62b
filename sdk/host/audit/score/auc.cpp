#include "host/audit/score/auc.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sphc::host {

Auc areaUnderCurve(const std::vector<double> &scores, const std::vector<bool> &positive) {
  std::vector<size_t> order(scores.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return scores[a] < scores[b]; });
  double below = 0, wins = 0, positives = 0, ties = 0;  // below: negatives that score less
  for (size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    double yes = 0, no = 0;
    for (; end < order.size() && scores[order[end]] == scores[order[begin]]; ++end)
      (positive[order[end]] ? yes : no) += 1;
    wins += yes * (below + no / 2);
    below += no;
    positives += yes;
    ties += std::pow(yes + no, 3) - (yes + no);
  }
  if (positives == 0 || below == 0) return {0.5, 0.5, 0.5};
  const double a = wins / (positives * below), q1 = a / (2 - a), q2 = 2 * a * a / (1 + a);
  const double variance =
      (a * (1 - a) + (positives - 1) * (q1 - a * a) + (below - 1) * (q2 - a * a)) / (positives * below);
  const double n = positives + below;
  const double of_chance = (n + 1) / (12 * positives * below) * (1 - ties / (n * n * n - n));
  return {a, std::sqrt(std::max(variance, 0.0)), std::sqrt(std::max(of_chance, 0.0))};
}

}  // namespace sphc::host
