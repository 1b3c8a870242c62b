#include "host/import/twins.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "host/import/descriptors.h"

namespace sphc::host {
namespace {

constexpr double kTwinM = 0.015;         // points so near to each other ...
constexpr double kTwinDescriptor = 220;  // ... and so alike are one

}  // namespace

std::vector<ModelPoint> withoutTwins(std::vector<ModelPoint> points) {
  std::stable_sort(points.begin(), points.end(),
                   [](const ModelPoint &a, const ModelPoint &b) { return a.observations > b.observations; });
  std::map<std::tuple<int, int, int>, std::vector<size_t>> cells;
  std::vector<ModelPoint> kept;
  const auto cellOf = [](double x) { return static_cast<int>(std::floor(x / kTwinM)); };
  for (const ModelPoint &point : points) {
    const int x = cellOf(point.position_m.x()), y = cellOf(point.position_m.y()), z = cellOf(point.position_m.z());
    bool twin = false;
    for (int dx = -1; dx <= 1 && !twin; ++dx)
      for (int dy = -1; dy <= 1 && !twin; ++dy)
        for (int dz = -1; dz <= 1 && !twin; ++dz) {
          const auto cell = cells.find({x + dx, y + dy, z + dz});
          if (cell == cells.end()) continue;
          for (size_t i : cell->second)
            twin = twin || ((kept[i].position_m - point.position_m).norm() < kTwinM &&
                            descriptorDistance(kept[i].descriptor, point.descriptor) < kTwinDescriptor);
        }
    if (twin) continue;
    cells[{x, y, z}].push_back(kept.size());
    kept.push_back(point);
  }
  return kept;
}

}  // namespace sphc::host
