// How many of the highest scores are positives.
#pragma once
#include <vector>

namespace sphc::host {

// Of the `share` of the entries that score highest, at least one; equals in their order.
double precisionAtTop(const std::vector<double> &scores, const std::vector<bool> &positive, double share);

}  // namespace sphc::host
