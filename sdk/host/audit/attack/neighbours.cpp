#include "host/audit/attack/neighbours.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

#include "host/audit/attack/nearest_points.h"
#include "host/base/on_threads.h"
#include "runtime/stages/match/distance.h"

namespace sphc::host {
namespace {

// The device's search of cells does for any table: all rows are one group.
class Table {
 public:
  explicit Table(const std::vector<Descriptor> &rows)
      : wide_(rows.size()), length2_(rows.size()), ends_{0, static_cast<uint32_t>(rows.size())} {
    widenRows({rows.data(), rows.size()}, {wide_.data(), wide_.size()}, {length2_.data(), length2_.size()});
    table_.groups = {wide_.data(), 1};
    table_.cells = {wide_.data(), wide_.size()};
    table_.group_begins = {ends_, 2};
    table_.group_length2 = {length2_.data(), 1};
    table_.cell_length2 = {length2_.data(), length2_.size()};
  }

  std::vector<Ranked> nearest(const Descriptor &query, size_t count) const {
    Ranked all[1] = {{UINT32_MAX, 0}};
    std::vector<Ranked> best(count, {UINT32_MAX, 0});
    rankCells(table_, query, {all, 1}, {best.data(), best.size()});
    return best;
  }

 private:
  std::vector<WideRow> wide_;
  std::vector<uint32_t> length2_;
  uint32_t ends_[2];
  CellTable table_ = {};
};

// Without the point itself; where more than `count` are equal to it, it may not have been found.
void keepOthers(const std::vector<Ranked> &found, Eigen::Index point, Neighbours *neighbours) {
  Eigen::Index k = 0;
  for (const Ranked &other : found) {
    if (other.index == static_cast<uint32_t>(point) || k == neighbours->indices.cols()) continue;
    neighbours->indices(point, k) = static_cast<int>(other.index);
    neighbours->distances(point, k++) = std::sqrt(static_cast<float>(other.distance2));
  }
}

// Calls take(query, the `count` nearest of `rows`) for each query, from several threads.
template <typename Take>
void searchAll(const std::vector<Descriptor> &queries, const std::vector<Descriptor> &rows, size_t count,
               const Take &take) {
  const Table table(rows);
  std::atomic<size_t> next{0};
  onThreads(std::max(1u, std::thread::hardware_concurrency()), [&](size_t) {
    for (size_t i = next++; i < queries.size(); i = next++)
      take(static_cast<Eigen::Index>(i), table.nearest(queries[i], count));
  });
}

}  // namespace

Neighbours directionNeighbours(const std::vector<Vector3> &directions, int count) {
  const NearestPoints nearest(directions);
  const auto points = static_cast<Eigen::Index>(directions.size());
  Neighbours neighbours = {Eigen::ArrayXXi(points, count), Eigen::ArrayXXf(points, count)};
  for (Eigen::Index i = 0; i < points; ++i) {
    Eigen::Index k = 0;
    for (const size_t j : nearest.find(directions[i], static_cast<size_t>(count) + 1)) {
      if (j == static_cast<size_t>(i) || k == count) continue;
      neighbours.indices(i, k) = static_cast<int>(j);
      neighbours.distances(i, k++) = static_cast<float>((directions[j] - directions[i]).norm());
    }
  }
  return neighbours;
}

Neighbours descriptorNeighbours(const std::vector<Descriptor> &descriptors, int count) {
  const auto points = static_cast<Eigen::Index>(descriptors.size());
  Neighbours neighbours = {Eigen::ArrayXXi(points, count), Eigen::ArrayXXf(points, count)};
  searchAll(descriptors, descriptors, static_cast<size_t>(count) + 1,
            [&](Eigen::Index i, const std::vector<Ranked> &found) { keepOthers(found, i, &neighbours); });
  return neighbours;
}

Neighbours nearestDescriptors(const std::vector<Descriptor> &queries, const std::vector<Descriptor> &table,
                              int count) {
  const auto rows = static_cast<Eigen::Index>(queries.size());
  Neighbours nearest = {Eigen::ArrayXXi(rows, count), Eigen::ArrayXXf(rows, count)};
  searchAll(queries, table, static_cast<size_t>(count), [&](Eigen::Index i, const std::vector<Ranked> &found) {
    for (Eigen::Index k = 0; k < count; ++k) {
      nearest.indices(i, k) = static_cast<int>(found[static_cast<size_t>(k)].index);
      nearest.distances(i, k) = std::sqrt(static_cast<float>(found[static_cast<size_t>(k)].distance2));
    }
  });
  return nearest;
}

}  // namespace sphc::host
