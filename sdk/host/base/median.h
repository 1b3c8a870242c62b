// The median of some numbers.
#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

namespace sphc::host {

// Of an even number of them the upper one; 0 of none.
inline double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace sphc::host
