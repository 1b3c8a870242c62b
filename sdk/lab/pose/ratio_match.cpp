#include "lab/pose/ratio_match.h"

#include <limits>

namespace sphc::host {
namespace {

constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

uint32_t squaredDistance(const Descriptor &a, const Descriptor &b) {
  int32_t sum = 0;
  for (size_t i = 0; i < sizeof a.bytes; ++i) {
    const int32_t difference = a.bytes[i] - b.bytes[i];
    sum += difference * difference;
  }
  return static_cast<uint32_t>(sum);
}

struct Nearest {
  uint32_t point = kNone, first = kNone, second = kNone;  // squared distances
};

Nearest nearestOf(const Descriptor &query, const std::vector<Descriptor> &points) {
  Nearest nearest;
  for (uint32_t i = 0; i < points.size(); ++i) {
    const uint32_t squared = squaredDistance(query, points[i]);
    if (squared < nearest.first)
      nearest = {i, squared, nearest.first};
    else if (squared < nearest.second)
      nearest.second = squared;
  }
  return nearest;
}

}  // namespace

std::vector<RatioMatch> matchByRatio(const std::vector<Descriptor> &queries, const std::vector<Descriptor> &points,
                                     double ratio) {
  std::vector<RatioMatch> accepted;
  std::vector<size_t> match_of_point(points.size(), kNone);
  for (uint32_t q = 0; q < queries.size(); ++q) {
    const Nearest nearest = nearestOf(queries[q], points);
    if (nearest.point == kNone || !(nearest.first < ratio * ratio * nearest.second)) continue;
    const RatioMatch match = {q, nearest.point, nearest.first};
    size_t &taken = match_of_point[nearest.point];
    if (taken == kNone) {
      taken = accepted.size();
      accepted.push_back(match);
    } else if (match.squared_distance < accepted[taken].squared_distance) {
      accepted[taken] = match;
    }
  }
  return accepted;
}

}  // namespace sphc::host
