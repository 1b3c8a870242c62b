#include "host/audit/attack/density.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "host/audit/attack/nearest_points.h"

namespace sphc::host {
namespace {

constexpr double kLeastSine2 = 1e-6;  // of the angle between lines that are not parallel: 0.06 degrees
constexpr float kFar2 = std::numeric_limits<float>::max();

// Lines by coordinate, so that a line's distances to all others are a loop over vectors.
struct LineColumns {
  explicit LineColumns(const std::vector<Line> &lines) {
    for (int k = 0; k < 3; ++k) {
      for (const Line &line : lines) {
        point[k].push_back(static_cast<float>(line.point_m[k]));
        direction[k].push_back(static_cast<float>(line.direction[k]));
      }
    }
  }
  std::vector<float> point[3], direction[3];
};

// Squared distances of a line from all, far for parallels (and for itself).
void squaredDistances(const LineColumns &c, size_t line, std::vector<float> *squared) {
  const float px = c.point[0][line], py = c.point[1][line], pz = c.point[2][line];
  const float dx = c.direction[0][line], dy = c.direction[1][line], dz = c.direction[2][line];
  const float *qx = c.point[0].data(), *qy = c.point[1].data(), *qz = c.point[2].data();
  const float *ex = c.direction[0].data(), *ey = c.direction[1].data(), *ez = c.direction[2].data();
  float *out = squared->data();
  for (size_t i = 0; i < squared->size(); ++i) {
    const float nx = dy * ez[i] - dz * ey[i], ny = dz * ex[i] - dx * ez[i], nz = dx * ey[i] - dy * ex[i];
    const float sine2 = nx * nx + ny * ny + nz * nz;
    const float across = nx * (qx[i] - px) + ny * (qy[i] - py) + nz * (qz[i] - pz);
    out[i] = sine2 > static_cast<float>(kLeastSine2) ? across * across / sine2 : kFar2;
  }
}

// The lines that pass closest to one; of those at the same distance the first.
std::vector<uint32_t> closestLines(const LineColumns &columns, size_t line, size_t count,
                                   std::vector<float> *squared, std::vector<float> *sorted) {
  squaredDistances(columns, line, squared);
  count = std::min(count, squared->size() - 1);  // itself is far
  *sorted = *squared;
  std::nth_element(sorted->begin(), sorted->begin() + static_cast<ptrdiff_t>(count) - 1, sorted->end());
  const float farthest = (*sorted)[count - 1];
  std::vector<uint32_t> closest, last;
  for (uint32_t i = 0; i < squared->size(); ++i) {
    if ((*squared)[i] < farthest) closest.push_back(i);
    if ((*squared)[i] == farthest && last.size() < count) last.push_back(i);
  }
  closest.insert(closest.end(), last.begin(), last.begin() + static_cast<ptrdiff_t>(count - closest.size()));
  return closest;
}

template <typename Index>
Vector3 peakOf(const std::vector<Line> &lines, size_t line, const std::vector<Index> &neighbours,
               double peak_share) {
  std::vector<double> votes_m;
  for (const Index other : neighbours) {
    if (other == line) continue;
    const double vote_m = closestAlong(lines[line], lines[other]);
    if (!std::isnan(vote_m)) votes_m.push_back(vote_m);
  }
  const double at_m = densestOf(std::move(votes_m), peak_share);
  return lines[line].point_m + (std::isnan(at_m) ? 0 : at_m) * lines[line].direction;
}

}  // namespace

double closestAlong(const Line &line, const Line &other) {
  const double cosine = line.direction.dot(other.direction), sine2 = 1 - cosine * cosine;
  if (!(sine2 > kLeastSine2)) return std::numeric_limits<double>::quiet_NaN();
  return (other.point_m - line.point_m).dot(line.direction - cosine * other.direction) / sine2;
}

double densestOf(std::vector<double> votes_m, double peak_share) {
  if (votes_m.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(votes_m.begin(), votes_m.end());
  const auto held = std::clamp<size_t>(
      static_cast<size_t>(std::lround(peak_share * static_cast<double>(votes_m.size()))), 1, votes_m.size());
  size_t best = 0;
  for (size_t i = 0; i + held <= votes_m.size(); ++i)
    if (votes_m[i + held - 1] - votes_m[i] < votes_m[best + held - 1] - votes_m[best]) best = i;
  return votes_m[best + held / 2];
}

std::vector<Vector3> attackByDensity(const std::vector<Line> &lines, const DensityAttackOptions &options,
                                     const AttackProgress &progress) {
  if (lines.size() < 2 || options.neighbours == 0)
    throw std::runtime_error("the density attack needs two lines and a neighbour at least; give a larger cloud");
  const uint64_t total = lines.size() * (1 + static_cast<uint64_t>(options.rounds));
  uint64_t done = 0;
  const auto tell = [&] {
    if (progress) progress(++done, total);
  };
  const LineColumns columns(lines);
  std::vector<float> squared(lines.size()), sorted;
  std::vector<Vector3> points_m;
  for (size_t i = 0; i < lines.size(); ++i, tell())
    points_m.push_back(
        peakOf(lines, i, closestLines(columns, i, options.neighbours, &squared, &sorted), options.peak_share));
  for (uint32_t round = 0; round < options.rounds; ++round) {
    const std::vector<Vector3> before_m = points_m;
    const NearestPoints tree(before_m);
    for (size_t i = 0; i < lines.size(); ++i, tell())
      points_m[i] = peakOf(lines, i, tree.find(before_m[i], options.neighbours + 1), options.peak_share);
  }
  return points_m;
}

}  // namespace sphc::host
