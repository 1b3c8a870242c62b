#include "host/import/near_duplicates.h"

#include <algorithm>
#include <cmath>

#include "host/import/point_grid.h"

namespace sphc::host {

double descriptorDistance(const Descriptor &a, const Descriptor &b) {
  int sum = 0;
  for (size_t i = 0; i < kDescriptorBytes; ++i) {
    const int d = a.bytes[i] - b.bytes[i];
    sum += d * d;
  }
  return std::sqrt(static_cast<double>(sum));
}

PointModel withoutNearDuplicates(PointModel model, const NearDuplicateRule &rule) {
  std::stable_sort(model.points.begin(), model.points.end(),
                   [](const ModelPoint &a, const ModelPoint &b) { return a.observations > b.observations; });
  PointGrid grid(rule.radius_m);
  PointModel kept;
  kept.band = model.band;
  for (const ModelPoint &point : model.points) {
    bool is_near_duplicate = false;
    grid.forEachNear(point.position_m, rule.radius_m, [&](size_t i, double distance_m) {
      is_near_duplicate = is_near_duplicate || (distance_m < rule.radius_m &&
                                                descriptorDistance(kept.points[i].descriptor, point.descriptor) <
                                                    rule.descriptor_distance);
    });
    if (is_near_duplicate) continue;
    grid.add(point.position_m, kept.points.size());
    kept.points.push_back(point);
  }
  return kept;
}

}  // namespace sphc::host
