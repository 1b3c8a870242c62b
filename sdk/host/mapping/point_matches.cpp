#include "host/mapping/point_matches.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "runtime/stages/match/distance.h"

namespace sphc::host {
namespace {

constexpr double kMostRatio = 0.85;  // on distances
constexpr double kReach = 0.08;      // of a prediction, in rays (x, y, 1); twice what a good pose is off
constexpr NearestTwo kNothing = {UINT32_MAX, UINT32_MAX, 0};

bool isClear(const NearestTwo &nearest) {
  return nearest.best2 != UINT32_MAX && nearest.best2 < kMostRatio * kMostRatio * nearest.second2;
}

Span<const Descriptor> spanOf(const std::vector<Descriptor> &descriptors) {
  return {descriptors.data(), descriptors.size()};
}

std::vector<NearestTwo> nearest(const WalkFrame &among, const WalkFrame &of, const std::vector<uint32_t> &chosen) {
  std::vector<NearestTwo> found(of.descriptors.size(), kNothing);
  searchRange(spanOf(among.descriptors), 0, static_cast<uint32_t>(among.descriptors.size()), spanOf(of.descriptors),
              {chosen.data(), chosen.size()}, {found.data(), found.size()});
  return found;
}

// Keypoints of a frame by where they lie.
class RayGrid {
 public:
  explicit RayGrid(const WalkFrame &frame) : frame_(frame) {
    for (uint32_t i = 0; i < frame.points.size(); ++i) cells_[cellAt(frame.points[i].ray)].push_back(i);
  }
  void near(const Vector2 &ray, std::vector<uint32_t> *found) const {
    found->clear();
    for (double dy : {-kReach, 0.0, kReach})
      for (double dx : {-kReach, 0.0, kReach}) {
        const auto cell = cells_.find(cellAt(ray + Vector2(dx, dy)));
        if (cell == cells_.end()) continue;
        for (uint32_t i : cell->second)
          if ((frame_.points[i].ray - ray).squaredNorm() < kReach * kReach) found->push_back(i);
      }
  }

 private:
  static int64_t cellAt(const Vector2 &ray) {
    const auto column = static_cast<int64_t>(std::floor(ray.x() / kReach)),
               row = static_cast<int64_t>(std::floor(ray.y() / kReach));
    return row * 1000000 + column;
  }
  const WalkFrame &frame_;
  std::unordered_map<int64_t, std::vector<uint32_t>> cells_;
};

}  // namespace

std::vector<PointMatch> matchAll(const WalkFrame &a, const WalkFrame &b) {
  std::vector<uint32_t> all(a.descriptors.size());
  for (uint32_t i = 0; i < all.size(); ++i) all[i] = i;
  const std::vector<NearestTwo> forward = nearest(b, a, all);
  std::vector<uint32_t> wanted;
  for (const NearestTwo &n : forward)
    if (isClear(n)) wanted.push_back(n.best_index);
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  const std::vector<NearestTwo> back = nearest(a, b, wanted);
  std::vector<PointMatch> matches;
  for (uint32_t i : all) {
    const NearestTwo &there = forward[i];
    if (isClear(there) && isClear(back[there.best_index]) && back[there.best_index].best_index == i)
      matches.push_back({i, there.best_index});
  }
  return matches;
}

std::vector<PointMatch> matchNear(const WalkFrame &a, const WalkFrame &b, const Rigid &b_from_a) {
  const RayGrid grid(b);
  std::vector<uint32_t> candidates;
  struct Best {
    uint32_t a = UINT32_MAX, distance2 = UINT32_MAX;
  };
  std::vector<Best> best(b.points.size());
  for (uint32_t i = 0; i < a.points.size(); ++i) {
    if (!a.points[i].hasDepth()) continue;
    const Vector3 expected_m = b_from_a * a.points[i].point_m();
    if (!(expected_m.z() > 0)) continue;
    grid.near(expected_m.head<2>() / expected_m.z(), &candidates);
    NearestTwo two = kNothing;
    searchCandidates(spanOf(b.descriptors), {candidates.data(), candidates.size()}, a.descriptors[i], &two);
    if (isClear(two) && two.best2 < best[two.best_index].distance2) best[two.best_index] = {i, two.best2};
  }
  std::vector<PointMatch> matches;
  for (uint32_t k = 0; k < best.size(); ++k)
    if (best[k].a != UINT32_MAX) matches.push_back({best[k].a, k});
  return matches;
}

}  // namespace sphc::host
