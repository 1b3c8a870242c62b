#include "host/import/descriptors.h"

#include <cmath>
#include <limits>

namespace sphc::host {

double descriptorDistance(const Descriptor &a, const Descriptor &b) {
  int sum = 0;
  for (size_t i = 0; i < kDescriptorBytes; ++i) {
    const int d = a.bytes[i] - b.bytes[i];
    sum += d * d;
  }
  return std::sqrt(static_cast<double>(sum));
}

size_t medoidOf(const std::vector<const Descriptor *> &descriptors) {
  size_t best = 0;
  double best_sum = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < descriptors.size(); ++i) {
    double sum = 0;
    for (const Descriptor *other : descriptors) sum += descriptorDistance(*descriptors[i], *other);
    if (sum < best_sum) best_sum = sum, best = i;
  }
  return best;
}

}  // namespace sphc::host
