#include "host/import/descriptors.h"

#include <limits>

#include "host/import/near_duplicates.h"

namespace sphc::host {

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
