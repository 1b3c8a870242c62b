#include "host/audit/attack/stack_features.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "host/base/median.h"
#include "runtime/base/elementary.h"

namespace sphc::host {
namespace {

using Eigen::ArrayXf;
using Eigen::Index;
using Row = Eigen::Ref<Eigen::RowVectorXf>;

constexpr int kBestElsewhere = 6;
constexpr float kFarLooks = 450;                                     // of descriptors: no more alike than strangers
constexpr float kSoftenRad = 0.02f, kNobodyRad = 1.5f;               // added to angles; where too few look alike
constexpr float kBinsDeg[] = {2, 4, 6, 8, 10, 13, 17, 25, 40, 181};  // upper ends
constexpr Index kAngleBins = std::size(kBinsDeg), kOfBest = 5;
constexpr double kPatchRad = 0.07;  // half a patch, about: the unit of places in a stack

float angleOf(const Vector3 &a, const Vector3 &b) {
  return static_cast<float>(std::acos(std::clamp(a.dot(b), -1.0, 1.0)));
}

// Of the six that look most alike elsewhere: how alike the best is and all are; how near, in direction, the best
// is, the nearest is and all are.
void describeBest(const std::vector<Vector3> &directions, const Neighbours &alike,
                  const std::vector<uint32_t> &stacks, size_t point, Row out) {
  float looks[kBestElsewhere], logs[kBestElsewhere];
  std::fill_n(looks, kBestElsewhere, kFarLooks);
  std::fill_n(logs, kBestElsewhere, std::log(kNobodyRad + kSoftenRad));
  int found = 0;
  for (Index k = 0; k < alike.indices.cols() && found < kBestElsewhere; ++k) {
    const auto other = static_cast<size_t>(alike.indices(static_cast<Index>(point), k));
    if (stacks[other] == stacks[point]) continue;
    looks[found] = std::min(alike.distances(static_cast<Index>(point), k), kFarLooks);
    logs[found++] = std::log(angleOf(directions[point], directions[other]) + kSoftenRad);
  }
  const Eigen::Map<const Eigen::Array<float, kBestElsewhere, 1>> all_looks(looks), all_logs(logs);
  out << looks[0], all_looks.mean(), logs[0], all_logs.minCoeff(), all_logs.mean();
}

// How alike the best is among those so far away, own stack or not.
void describeBins(const std::vector<Vector3> &directions, const Neighbours &alike, size_t point, Row out) {
  out.setConstant(kFarLooks);
  for (Index k = 0; k < alike.indices.cols(); ++k) {
    const auto other = static_cast<size_t>(alike.indices(static_cast<Index>(point), k));
    const float angle_deg = angleOf(directions[point], directions[other]) * static_cast<float>(180 / kPi);
    const auto bin =
        std::find_if(std::begin(kBinsDeg), std::end(kBinsDeg), [&](float end) { return angle_deg < end; });
    float &best = out[std::min(bin - std::begin(kBinsDeg), kAngleBins - 1)];
    best = std::min(best, alike.distances(static_cast<Index>(point), k));
  }
}

// Where in its stack each point is, in patches from the middle, and how many share the stack.
void describePlaces(const std::vector<Vector3> &directions, const std::vector<uint32_t> &stacks,
                    Eigen::Ref<Eigen::MatrixXf> out) {
  std::vector<Vector3> sums(1 + *std::max_element(stacks.begin(), stacks.end()), Vector3::Zero());
  std::vector<float> counts(sums.size(), 0);
  for (size_t i = 0; i < stacks.size(); ++i) {
    sums[stacks[i]] += directions[i];
    ++counts[stacks[i]];
  }
  for (size_t i = 0; i < stacks.size(); ++i) {
    const double radius = (directions[i] - sums[stacks[i]].normalized()).norm() / kPatchRad;
    out.row(static_cast<Index>(i)) << static_cast<float>(radius), static_cast<float>(radius * radius),
        std::log(counts[stacks[i]]);
  }
}

}  // namespace

Eigen::MatrixXf stackFeatures(const std::vector<Vector3> &directions, const MapNeighbours &neighbours,
                              const std::vector<uint32_t> &stacks) {
  Eigen::MatrixXf values(static_cast<Index>(directions.size()), kStackFeatures);
  Index next = 0;
  const auto take = [&](Index columns) {
    next += columns;
    return values.middleCols(next - columns, columns);
  };
  auto best = take(kOfBest), best_mirrored = take(kOfBest), bins = take(kAngleBins),
       bins_mirrored = take(kAngleBins);
  for (size_t i = 0; i < directions.size(); ++i) {
    const auto row = static_cast<Index>(i);
    Eigen::RowVectorXf found(kOfBest + kAngleBins);
    const auto describe = [&](const Neighbours &alike, auto &&of_best, auto &&of_bins) {
      describeBest(directions, alike, stacks, i, found.head(kOfBest));
      describeBins(directions, alike, i, found.tail(kAngleBins));
      of_best.row(row) = found.head(kOfBest);
      of_bins.row(row) = found.tail(kAngleBins);
    };
    describe(neighbours.alike, best, bins);
    describe(neighbours.mirrored, best_mirrored, bins_mirrored);
  }
  take(2) = best.leftCols(2) - best_mirrored.leftCols(2);
  take(kAngleBins) = bins - bins_mirrored;
  for (const Index k : {7, 31, 47}) {
    const ArrayXf spacing = (neighbours.beside.distances.col(k) + 1e-4f).log();
    take(1) = (spacing - static_cast<float>(median({spacing.begin(), spacing.end()}))).matrix();
  }
  describePlaces(directions, stacks, take(3));
  return values;
}

}  // namespace sphc::host
