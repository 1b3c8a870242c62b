#include "host/audit/attack/real_or_fake_features.h"

#include <algorithm>
#include <cmath>

#include "host/base/median.h"
#include "runtime/stages/match/distance.h"

namespace sphc::host {
namespace {

using Eigen::ArrayXf;
using Eigen::ArrayXXf;
using Eigen::Index;

constexpr int kNearLookalikes = 16, kPaired = 12, kShownComponents = 16;

class Columns {
 public:
  explicit Columns(Index rows) : values_(rows, kRealOrFakeFeatures) {}
  void add(const ArrayXf &column) { values_.col(next_++) = column.matrix(); }
  Eigen::MatrixXf take() { return std::move(values_); }

 private:
  Eigen::MatrixXf values_;
  Index next_ = 0;
};

ArrayXXf sortedRows(ArrayXXf values) {
  for (Index i = 0; i < values.rows(); ++i) {
    std::vector<float> row(static_cast<size_t>(values.cols()));
    for (Index k = 0; k < values.cols(); ++k) row[static_cast<size_t>(k)] = values(i, k);
    std::sort(row.begin(), row.end());
    for (Index k = 0; k < values.cols(); ++k) values(i, k) = row[static_cast<size_t>(k)];
  }
  return values;
}

// Mean of a column over the first `count` neighbours of each point.
ArrayXf meanOfNeighbours(const ArrayXf &column, const Neighbours &neighbours, Index count) {
  ArrayXf mean = ArrayXf::Zero(column.size());
  for (Index k = 0; k < count; ++k)
    for (Index i = 0; i < column.size(); ++i) mean[i] += column[neighbours.indices(i, k)];
  return mean / static_cast<float>(count);
}

// Spacing at several scales: against the map's own, so that large and small maps are alike, and the neighbours'.
ArrayXf addDensity(const Neighbours &beside, Columns *columns) {
  ArrayXXf spacing = (beside.distances + 1e-6f).log();
  const auto eighth = spacing.col(7);
  spacing -= static_cast<float>(median({eighth.begin(), eighth.end()}));
  for (const Index k : {0, 1, 3, 7, 15, 31, 47}) columns->add(spacing.col(k));
  columns->add(spacing.col(7) - spacing.col(0));
  columns->add(spacing.col(47) - spacing.col(7));
  columns->add(spacing.col(7) - meanOfNeighbours(spacing.col(7), beside, 16));
  columns->add(spacing.col(3) - meanOfNeighbours(spacing.col(3), beside, 8));
  return -spacing.col(15);
}

// Distances of descriptors to those of the neighbours in direction.
void addLooksBeside(const std::vector<Descriptor> &descriptors, const Neighbours &beside, Columns *columns) {
  ArrayXXf distances(beside.indices.rows(), kBeside);
  for (Index i = 0; i < distances.rows(); ++i)
    for (Index k = 0; k < kBeside; ++k)
      distances(i, k) = std::sqrt(static_cast<float>(distance2(descriptors[i], descriptors[beside.indices(i, k)])));
  for (const Index k : {4, 8, 16, 32, 48}) {
    columns->add(distances.leftCols(k).rowwise().mean());
    columns->add(distances.leftCols(k).rowwise().minCoeff());
  }
  const ArrayXXf sorted = sortedRows(distances.leftCols(16));
  for (const Index k : {1, 2, 4}) columns->add(sorted.col(k));
}

// How far those lie that look like it.
ArrayXf addLookalikes(const Published &map, const Neighbours &alike, Columns *columns) {
  ArrayXXf chords(alike.indices.rows(), kNearLookalikes);
  for (Index i = 0; i < chords.rows(); ++i)
    for (Index k = 0; k < kNearLookalikes; ++k)
      chords(i, k) = static_cast<float>((map.directions[i] - map.directions[alike.indices(i, k)]).norm());
  const ArrayXXf logs = (chords + 1e-4f).log();
  columns->add(logs.col(0));
  for (const Index k : {3, 8, 16}) {
    columns->add(logs.leftCols(k).rowwise().minCoeff());
    columns->add(logs.leftCols(k).rowwise().mean());
  }
  for (const Index k : {0, 3, 15}) columns->add(alike.distances.col(k));
  for (const float radius : {0.03f, 0.1f, 0.3f}) columns->add((chords < radius).cast<float>().rowwise().sum());
  return -logs.leftCols(8).rowwise().mean();
}

// Where fakes are mirror images, most of what a real point resembles is its own mirror image.
ArrayXf addMirror(const MapNeighbours &neighbours, Columns *columns) {
  const ArrayXf cue = ((neighbours.alike.distances.col(0) + 1) / (neighbours.mirrored.distances.col(0) + 1)).log();
  columns->add(cue);
  columns->add(meanOfNeighbours(cue, neighbours.beside, 16));
  return cue;
}

ArrayXf addCoOccurrence(const Eigen::MatrixXf &components, const Neighbours &beside, const CoOccurrence &network,
                        Columns *columns) {
  ArrayXXf logits(components.rows(), kPaired);
  for (Index k = 0; k < kPaired; ++k) {
    Eigen::MatrixXf other(components.rows(), components.cols());
    for (Index i = 0; i < components.rows(); ++i) other.row(i) = components.row(beside.indices(i, k));
    logits.col(k) = network.logits(components, other);
  }
  for (const Index k : {4, 8, 12}) columns->add(logits.leftCols(k).rowwise().mean());
  columns->add(logits.leftCols(8).rowwise().maxCoeff());
  columns->add(sortedRows(logits).rightCols(3).rowwise().mean());
  return logits.rowwise().mean();
}

}  // namespace

RealOrFakeFeatures realOrFakeFeatures(const Published &map, const MapNeighbours &neighbours,
                                      const CoOccurrence &co_occurrence) {
  const Neighbours &beside = neighbours.beside;
  Columns columns(static_cast<Index>(map.directions.size()));
  RealOrFakeFeatures features;
  features.density = addDensity(beside, &columns);
  addLooksBeside(map.descriptors, beside, &columns);
  features.lookalikes = addLookalikes(map, neighbours.alike, &columns);
  features.mirror = addMirror(neighbours, &columns);
  const Eigen::MatrixXf components = co_occurrence.components(map.descriptors);
  features.co_occurrence = addCoOccurrence(components, beside, co_occurrence, &columns);
  for (Index c = 0; c < kShownComponents; ++c) columns.add(components.col(c));
  features.values = columns.take();
  return features;
}

}  // namespace sphc::host
