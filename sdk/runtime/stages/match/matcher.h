// Matches query descriptors to map points: over the whole map, or, once a pose is roughly known, only to points in
// the direction where the pose expects them.
#pragma once
#include "runtime/base/arena.h"
#include "runtime/map/map_view.h"
#include "runtime/stages/match/distance.h"
#include "runtime/types/match.h"

namespace sphc {

class Matcher {
 public:
  static void layout(uint32_t max_queries, Arena &scratch, Matcher *matcher);

  // Exact nearest neighbours over the whole map, Lowe's ratio test (on distances), and at most one query for each
  // map point.  Writes to `matches` (room for every query), best ratio first; returns how many.
  uint32_t matchAll(const MapView &map, Span<const Descriptor> queries, float max_ratio, Span<Match> matches);

  // The same among map points within `max_angle_cosine` of each query's expected direction (unit, map frame).
  uint32_t matchNear(const MapView &map, Span<const Descriptor> queries, Span<const Direction> expected,
                     float max_angle_cosine, float max_ratio, Span<Match> matches);

 private:
  uint32_t select(uint32_t count, float max_ratio, Span<Match> matches);

  Span<NearestTwo> nearest_;
  Span<float> expected_x_, expected_y_, expected_z_;
};

}  // namespace sphc
