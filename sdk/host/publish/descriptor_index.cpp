#include "host/publish/descriptor_index.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "runtime/map/sector.h"
#include "runtime/stages/match/distance.h"

namespace sphc::host {
namespace {

constexpr size_t kSampleOfCell = 64;  // descriptors that train a centroid
constexpr int kRounds = 10;
// Cells for the square root of the number of points: about as many centroids as points to compare with.
constexpr double kCellsOfRoot = 2.3;

// No more than points, whose first are where the cells begin.
uint32_t cellsFor(size_t points) {
  const double cells = std::round(kCellsOfRoot * std::sqrt(static_cast<double>(points)));
  return static_cast<uint32_t>(std::min({cells, static_cast<double>(points), double{kMapMaxCells}}));
}

uint32_t groupsFor(size_t cells) {
  const double groups = std::round(std::sqrt(static_cast<double>(cells)));
  return static_cast<uint32_t>(std::min<double>(groups, kMapMaxGroups));
}

// At most one sector a point, so that the table stays small.
uint32_t sectorSideFor(size_t points, size_t cells) {
  uint32_t side = 1;
  while (2 * side <= 16 && cells * (2 * side) * (2 * side) <= points) side *= 2;
  return side;
}

// The nearest centroid of each descriptor.
std::vector<uint32_t> assign(const std::vector<Descriptor> &descriptors, const std::vector<Descriptor> &centroids) {
  std::vector<NearestTwo> nearest(descriptors.size(), {UINT32_MAX, UINT32_MAX, 0});
  std::vector<uint32_t> everyone(descriptors.size());
  std::iota(everyone.begin(), everyone.end(), 0u);
  searchRange({centroids.data(), centroids.size()}, 0, static_cast<uint32_t>(centroids.size()),
              {descriptors.data(), descriptors.size()}, {everyone.data(), everyone.size()},
              {nearest.data(), nearest.size()});
  std::vector<uint32_t> labels;
  for (const NearestTwo &n : nearest) labels.push_back(n.best_index);
  return labels;
}

// The mean of each label's descriptors, rounded; a label that nobody has keeps its centroid.
void moveToMeans(const std::vector<Descriptor> &descriptors, const std::vector<uint32_t> &labels,
                 std::vector<Descriptor> *centroids) {
  std::vector<uint64_t> sums(centroids->size() * kDescriptorBytes), counts(centroids->size());
  for (size_t i = 0; i < descriptors.size(); ++i) {
    ++counts[labels[i]];
    uint64_t *sum = &sums[labels[i] * kDescriptorBytes];
    for (size_t k = 0; k < kDescriptorBytes; ++k) sum[k] += descriptors[i].bytes[k];
  }
  for (size_t c = 0; c < centroids->size(); ++c)
    for (size_t k = 0; counts[c] > 0 && k < kDescriptorBytes; ++k)
      (*centroids)[c].bytes[k] = static_cast<uint8_t>((sums[c * kDescriptorBytes + k] + counts[c] / 2) / counts[c]);
}

// Lloyd's k-means in integers, from the first `count` descriptors.
std::vector<Descriptor> kMeans(const std::vector<Descriptor> &descriptors, uint32_t count) {
  std::vector<Descriptor> centroids(descriptors.begin(), descriptors.begin() + count);
  for (int round = 0; round < kRounds; ++round)
    moveToMeans(descriptors, assign(descriptors, centroids), &centroids);
  return centroids;
}

// Items in the order of their labels, those of one label in their own order.
std::vector<uint32_t> sortedBy(const std::vector<uint32_t> &labels) {
  std::vector<uint32_t> order(labels.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return labels[a] < labels[b]; });
  return order;
}

// Where each label begins among items in the order of their labels, and their number.
std::vector<uint32_t> startsOf(const std::vector<uint32_t> &labels, size_t count) {
  std::vector<uint32_t> starts(count + 1);
  for (uint32_t label : labels) ++starts[label + 1];
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  return starts;
}

void groupCells(std::vector<Descriptor> cells, DescriptorIndex *index) {
  index->group_centroids = kMeans(cells, groupsFor(cells.size()));
  const std::vector<uint32_t> labels = assign(cells, index->group_centroids);
  index->groups = startsOf(labels, index->group_centroids.size());
  for (uint32_t cell : sortedBy(labels)) index->centroids.push_back(cells[cell]);
}

}  // namespace

DescriptorIndex makeIndex(const std::vector<Descriptor> &descriptors,
                          const std::vector<PackedDirection> &directions) {
  DescriptorIndex index;
  const uint32_t cells = cellsFor(descriptors.size());
  const size_t sample = std::min(descriptors.size(), kSampleOfCell * cells);
  groupCells(kMeans({descriptors.begin(), descriptors.begin() + static_cast<ptrdiff_t>(sample)}, cells), &index);
  index.sector_side = sectorSideFor(descriptors.size(), cells);
  const uint32_t sectors = index.sector_side * index.sector_side;
  std::vector<uint32_t> labels = assign(descriptors, index.centroids);
  for (size_t i = 0; i < labels.size(); ++i)
    labels[i] = labels[i] * sectors + sectorOf(directions[i], index.sector_side);
  index.order = sortedBy(labels);
  index.runs = startsOf(labels, size_t{cells} * sectors);
  return index;
}

}  // namespace sphc::host
