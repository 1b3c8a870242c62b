#include "host/audit/score/precision.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace sphc::host {

double precisionAtTop(const std::vector<double> &scores, const std::vector<bool> &positive, double share) {
  if (scores.empty() || positive.size() != scores.size())
    throw std::invalid_argument("precisionAtTop: a truth for each score is needed, and one score at least");
  std::vector<size_t> order(scores.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return scores[a] > scores[b]; });
  const double wanted = std::round(share * static_cast<double>(order.size()));
  const auto top = static_cast<size_t>(std::clamp(wanted, 1.0, static_cast<double>(order.size())));
  const auto hits = std::count_if(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(top),
                                  [&](size_t i) { return positive[i]; });
  return static_cast<double>(hits) / static_cast<double>(top);
}

}  // namespace sphc::host
