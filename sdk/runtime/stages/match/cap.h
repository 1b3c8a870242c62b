// Caps on the sphere, and which of a map's directions lie inside.
#pragma once
#include "runtime/base/span.h"
#include "runtime/map/packed_direction.h"

namespace sphc {

// Directions whose angle from `axis` (unit) has a cosine above `cosine`.
struct Cap {
  Direction axis;
  float cosine;
};

// Consecutive directions [begin, end).
struct DirectionRun {
  uint32_t begin, end;
};

constexpr uint32_t kCapOverread = 8;  // directions that may be read behind a run, so that many fit a vector

// Appends to `inside` the indices of the run's directions that lie in the cap, in their order; returns how many.
// `inside` has room for all of the run; kCapOverread directions behind the run can be read.
uint32_t findInside(const PackedDirection *directions, DirectionRun run, const Cap &cap, uint32_t *inside);

// The scalar twin.
uint32_t findInsideScalar(const PackedDirection *directions, DirectionRun run, const Cap &cap, uint32_t *inside);

}  // namespace sphc
