#include "runtime/stages/match/matcher.h"

#include <algorithm>

namespace sphc {
namespace {

constexpr uint32_t kTile = 256;  // map descriptors that stay in the nearest cache while all queries pass over them

constexpr uint32_t kNobody = UINT32_MAX;
// Two unrelated descriptors are seldom nearer than this; a lone candidate has to beat it by the ratio.
constexpr uint32_t kUnrelated2 = 300 * 300;
constexpr NearestTwo kStart = {kUnrelated2, kUnrelated2, kNobody};

bool passesRatio(const NearestTwo &nearest, float max_ratio) {
  if (nearest.best_index == kNobody) return false;
  return static_cast<double>(nearest.best2) <
         static_cast<double>(max_ratio) * static_cast<double>(max_ratio) * static_cast<double>(nearest.second2);
}

// A cone around all expected directions, widened by the cap: map points outside it are nobody's candidates.
struct Cone {
  Direction axis;
  float cosine;
};

Cone coneAround(Span<const Direction> directions, float cap_cosine) {
  Direction sum = {0.0f, 0.0f, 0.0f};
  for (const Direction &d : directions) sum = {sum.x + d.x, sum.y + d.y, sum.z + d.z};
  const float length = sqrtOf(sum.x * sum.x + sum.y * sum.y + sum.z * sum.z);
  if (!(length > 0.0f)) return {{0.0f, 0.0f, 1.0f}, -2.0f};
  const Direction axis = {sum.x / length, sum.y / length, sum.z / length};
  float widest = 1.0f;
  for (const Direction &d : directions) widest = std::min(widest, axis.x * d.x + axis.y * d.y + axis.z * d.z);
  // cos(a + b); a sum beyond 180 degrees takes everything in
  const float sines = sqrtOf(std::max(0.0f, (1.0f - widest * widest) * (1.0f - cap_cosine * cap_cosine)));
  const float cosine = widest <= -cap_cosine ? -2.0f : widest * cap_cosine - sines;
  return {axis, cosine - 1e-5f};
}

}  // namespace

void Matcher::layout(uint32_t max_queries, Arena &scratch, Matcher *matcher) {
  const Span<NearestTwo> nearest = scratch.take<NearestTwo>("match.nearest", max_queries);
  const Span<float> x = scratch.take<float>("match.expected", max_queries);
  const Span<float> y = scratch.take<float>("match.expected", max_queries);
  const Span<float> z = scratch.take<float>("match.expected", max_queries);
  if (!matcher) return;
  matcher->nearest_ = nearest;
  matcher->expected_x_ = x;
  matcher->expected_y_ = y;
  matcher->expected_z_ = z;
}

uint32_t Matcher::matchAll(const MapView &map, Span<const Descriptor> queries, float max_ratio,
                           Span<Match> matches) {
  const uint32_t count = static_cast<uint32_t>(queries.size());
  const Span<NearestTwo> nearest = nearest_.first(count);
  for (NearestTwo &n : nearest) n = kStart;
  for (uint32_t begin = 0; begin < map.pointCount(); begin += kTile)
    searchRange(map.descriptors(), begin, std::min(begin + kTile, map.pointCount()), queries, nearest);
  return select(count, max_ratio, matches);
}

uint32_t Matcher::matchNear(const MapView &map, Span<const Descriptor> queries, Span<const Direction> expected,
                            float max_angle_cosine, float max_ratio, Span<Match> matches) {
  const uint32_t count = static_cast<uint32_t>(queries.size());
  for (uint32_t q = 0; q < count; ++q) {
    nearest_[q] = kStart;
    expected_x_[q] = expected[q].x;
    expected_y_[q] = expected[q].y;
    expected_z_[q] = expected[q].z;
  }
  const float *ex = expected_x_.data(), *ey = expected_y_.data(), *ez = expected_z_.data();
  const Cone cone = coneAround(expected, max_angle_cosine);
  for (uint32_t i = 0; i < map.pointCount(); ++i) {
    const Direction d = map.direction(i);
    if (d.x * cone.axis.x + d.y * cone.axis.y + d.z * cone.axis.z < cone.cosine) continue;
    for (uint32_t q = 0; q < count; ++q)
      if (d.x * ex[q] + d.y * ey[q] + d.z * ez[q] > max_angle_cosine)
        nearest_[q].see(distance2(map.descriptors()[i], queries[q]), i);
  }
  return select(count, max_ratio, matches);
}

uint32_t Matcher::select(uint32_t count, float max_ratio, Span<Match> matches) {
  uint32_t n = 0;
  for (uint32_t q = 0; q < count; ++q)
    if (passesRatio(nearest_[q], max_ratio))
      matches[n++] = {q, nearest_[q].best_index, nearest_[q].best2, nearest_[q].second2};
  // One query for each map point: the nearest.
  std::sort(matches.data(), matches.data() + n, [](const Match &a, const Match &b) {
    if (a.map_index != b.map_index) return a.map_index < b.map_index;
    return a.distance2 != b.distance2 ? a.distance2 < b.distance2 : a.query < b.query;
  });
  n = static_cast<uint32_t>(std::unique(matches.data(), matches.data() + n,
                                        [](const Match &a, const Match &b) { return a.map_index == b.map_index; }) -
                            matches.data());
  std::sort(matches.data(), matches.data() + n, [](const Match &a, const Match &b) {
    const uint64_t left = uint64_t{a.distance2} * b.second2, right = uint64_t{b.distance2} * a.second2;
    return left != right ? left < right : a.query < b.query;
  });
  return n;
}

}  // namespace sphc
