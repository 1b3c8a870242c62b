#include "host/audit/attack/stacks.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/audit/attack/nearest_points.h"
#include "runtime/base/elementary.h"

namespace sphc::host {
namespace {

using Eigen::Index;

constexpr double kRadiansPerDegree = kPi / 180;
constexpr double kKernelRad = 1.6 * kRadiansPerDegree, kSameModeRad = 4 * kRadiansPerDegree;
constexpr size_t kStarts = 3000, kPulling = 256;  // directions that climb; points that pull on one
constexpr int kClimbs = 30, kMeans = 8;
constexpr double kArrivedRad = 1e-4;
constexpr int kBest = 6;
constexpr double kNear = 0.02, kNoneRad = 1.5;  // added to angles; where too few look alike elsewhere

struct Mode {
  Vector3 direction;
  double weight;  // of the points about it
};

Mode climb(Vector3 at, const std::vector<Vector3> &directions, const NearestPoints &nearest) {
  double weight = 0;
  for (int step = 0; step < kClimbs; ++step) {
    Vector3 sum = Vector3::Zero();
    weight = 0;
    for (const size_t i : nearest.find(at, kPulling)) {
      const double w = std::exp((at.dot(directions[i]) - 1) / (kKernelRad * kKernelRad));
      sum += w * directions[i];
      weight += w;
    }
    const Vector3 next = sum.normalized();
    const bool arrived = (next - at).norm() < kArrivedRad;
    at = next;
    if (arrived) break;
  }
  return {at, weight};
}

// The heaviest first; of those that lie together one.
std::vector<Vector3> distinct(std::vector<Mode> modes) {
  std::stable_sort(modes.begin(), modes.end(), [](const Mode &a, const Mode &b) { return a.weight > b.weight; });
  std::vector<Vector3> kept;
  for (const Mode &mode : modes) {
    const auto same = [&](const Vector3 &other) { return mode.direction.dot(other) > std::cos(kSameModeRad); };
    if (std::none_of(kept.begin(), kept.end(), same)) kept.push_back(mode.direction);
  }
  return kept;
}

std::vector<uint32_t> nearestOf(const std::vector<Vector3> &directions, const std::vector<Vector3> &middles) {
  const NearestPoints nearest(middles);
  std::vector<uint32_t> labels;
  for (const Vector3 &direction : directions)
    labels.push_back(static_cast<uint32_t>(nearest.find(direction, 1).front()));
  return labels;
}

}  // namespace

std::vector<uint32_t> stacksOf(const std::vector<Vector3> &directions) {
  const NearestPoints nearest(directions);
  std::vector<Mode> modes;
  const size_t step = std::max<size_t>(1, directions.size() / kStarts);
  for (size_t i = 0; i < directions.size(); i += step) modes.push_back(climb(directions[i], directions, nearest));
  std::vector<Vector3> middles = distinct(std::move(modes));
  std::vector<uint32_t> labels = nearestOf(directions, middles);
  for (int round = 0; round < kMeans; ++round) {
    std::vector<Vector3> sums(middles.size(), Vector3::Zero());
    for (size_t i = 0; i < directions.size(); ++i) sums[labels[i]] += directions[i];
    for (size_t k = 0; k < middles.size(); ++k)
      if (sums[k].norm() > 0) middles[k] = sums[k].normalized();
    labels = nearestOf(directions, middles);
  }
  return labels;
}

Eigen::ArrayXf lookalikesInOtherStacks(const std::vector<Vector3> &directions, const Neighbours &alike,
                                       const std::vector<uint32_t> &stacks) {
  Eigen::ArrayXf scores(alike.indices.rows());
  for (Index i = 0; i < scores.size(); ++i) {
    const auto point = static_cast<size_t>(i);
    int found = 0;
    double sum = 0;
    for (Index k = 0; k < alike.indices.cols() && found < kBest; ++k) {
      const auto other = static_cast<size_t>(alike.indices(i, k));
      if (stacks[other] == stacks[point]) continue;
      sum += std::log(std::acos(std::clamp(directions[point].dot(directions[other]), -1.0, 1.0)) + kNear);
      ++found;
    }
    sum += (kBest - found) * std::log(kNoneRad + kNear);
    scores[i] = static_cast<float>(-sum / kBest);
  }
  return scores;
}

}  // namespace sphc::host
