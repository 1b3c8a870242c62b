#include "host/report/coverage.h"

#include <algorithm>
#include <cmath>

#include "host/report/directions.h"

namespace sphc::host {
namespace {

using Direction = std::array<double, 3>;

constexpr size_t kProbes = 4000;  // about 3 degrees apart
constexpr size_t kCells = 200;    // of evenness: about 14 degrees across
constexpr double kNear = 5 * kDegree, kLeastHole = 10 * kDegree;

// Even on the sphere: heights at equal steps, turned by the golden angle each (Swinbank and Purser 2006).
std::vector<Direction> fibonacci(size_t count) {
  std::vector<Direction> directions(count);
  const double golden = M_PI * (3 - std::sqrt(5.0));
  for (size_t i = 0; i < count; ++i) {
    const double index = static_cast<double>(i);
    const double z = 1 - (2 * index + 1) / static_cast<double>(count), r = std::sqrt(1 - z * z);
    directions[i] = {r * std::cos(golden * index), r * std::sin(golden * index), z};
  }
  return directions;
}

double largestCosine(const Direction &probe, const std::vector<Direction> &directions) {
  double largest = -1;
  for (const Direction &d : directions) largest = std::max(largest, dotProduct(probe, d));
  return std::min(largest, 1.0);
}

double evennessOf(const std::vector<Direction> &directions) {
  const std::vector<Direction> middles = fibonacci(kCells);
  std::vector<double> counts(kCells, 0);
  for (const Direction &d : directions) {
    const auto nearest = std::max_element(
        middles.begin(), middles.end(),
        [&d](const Direction &a, const Direction &b) { return dotProduct(a, d) < dotProduct(b, d); });
    ++counts[static_cast<size_t>(nearest - middles.begin())];
  }
  double entropy = 0;
  for (double count : counts) {
    const double share = count / static_cast<double>(directions.size());
    if (share > 0) entropy -= share * std::log(share);
  }
  return std::exp(entropy) / static_cast<double>(kCells);
}

Hole holeAt(const Direction &middle, double radius) {
  return {std::atan2(middle[1], middle[0]) / kDegree, std::asin(std::clamp(middle[2], -1.0, 1.0)) / kDegree,
          radius / kDegree};
}

}  // namespace

Coverage coverageOf(const std::vector<Direction> &directions, size_t most_holes) {
  Coverage coverage;
  if (directions.empty()) return coverage;
  const std::vector<Direction> probes = fibonacci(kProbes);
  std::vector<std::pair<double, size_t>> emptiness;
  size_t covered = 0;
  for (size_t i = 0; i < probes.size(); ++i) {
    const double radius = std::acos(largestCosine(probes[i], directions));
    emptiness.emplace_back(radius, i);
    covered += radius < kNear;
  }
  coverage.covered_share = static_cast<double>(covered) / kProbes;
  coverage.evenness = evennessOf(directions);
  std::sort(emptiness.rbegin(), emptiness.rend());
  std::vector<std::pair<double, Direction>> taken;
  for (const auto &[radius, index] : emptiness) {
    if (taken.size() == most_holes || radius < kLeastHole) break;
    const Direction &middle = probes[index];
    const bool inside = std::any_of(taken.begin(), taken.end(), [&middle, reach = radius](const auto &other) {
      return std::acos(std::clamp(dotProduct(middle, other.second), -1.0, 1.0)) < other.first + reach;
    });
    if (inside) continue;
    taken.emplace_back(radius, middle);
    coverage.holes.push_back(holeAt(middle, radius));
  }
  return coverage;
}

}  // namespace sphc::host
