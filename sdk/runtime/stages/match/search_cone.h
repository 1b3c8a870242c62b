// Search cones around directions, and which of a map's directions lie inside.
#pragma once
#include "runtime/base/span.h"
#include "runtime/map/packed_direction.h"

namespace sphc {

// Directions whose angle from `axis` (unit) has a cosine above `cosine`.
struct SearchCone {
  Direction axis;
  float cosine;
};

// Consecutive directions [begin, end).
struct DirectionRun {
  uint32_t begin, end;
};

constexpr uint32_t kConeOverread = 8;  // directions that may be read behind a run, so that many fit a vector

// Writes to `inside` the indices of the runs' directions that lie in the cone, in their order; returns how many.
// `inside` has room for all of them; kConeOverread directions behind each run can be read.
uint32_t findInside(const PackedDirection *directions, Span<const DirectionRun> runs, const SearchCone &cone,
                    uint32_t *inside);

// The scalar version.
uint32_t findInsideScalar(const PackedDirection *directions, Span<const DirectionRun> runs, const SearchCone &cone,
                          uint32_t *inside);

}  // namespace sphc
