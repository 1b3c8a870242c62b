// Maps of any size and queries against them, for the measuring of matchers.
#pragma once
#include <memory>
#include <vector>

#include "runtime/geometry/rotation.h"
#include "runtime/map/map_view.h"

namespace sphc::host {

// A point as a matcher sees it: of a map, or of a frame whose pose is known.
struct MatchPoint {
  Vector3 direction;  // unit, from the map's centre
  Descriptor descriptor;
};

// `count` points: as many of `points` as fit, the first ones; then made ones, so that the map is of that size.  A
// made point has the descriptor of one of `points` mirrored or turned by a quarter (so it is of another place, but
// as lifelike), with noise on every byte, and its direction scattered as the paper's fakes are (sigma^2 0.1).
std::vector<MatchPoint> grownPoints(const std::vector<MatchPoint> &points, size_t count, uint64_t seed);

// The descriptor of a patch that is seen in a mirror (transform & 1), then turned by quarters (transform >> 1).
Descriptor transformed(const Descriptor &descriptor, uint32_t transform);

// An opened map and queries.
struct MatchCase {
  MapView map;
  std::vector<Descriptor> queries;
  std::vector<Direction> expected;  // where each lies, unit, map frame
  double map_bytes = 0, build_seconds = 0;
  std::shared_ptr<void> file;  // the map's bytes, aligned as a mapped file is
};

// Throws std::runtime_error when the file is no map.
MatchCase makeMatchCase(const std::vector<uint8_t> &map_file, uint32_t extractor, double build_seconds,
                        const std::vector<MatchPoint> &queries);

}  // namespace sphc::host
