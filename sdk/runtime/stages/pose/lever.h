// Which matches does a pose lean on most?
#pragma once
#include "runtime/base/fixed_vector.h"
#include "runtime/base/span.h"
#include "runtime/types/correspondence.h"
#include "runtime/types/estimate.h"

namespace sphc {

constexpr uint32_t kMostLevers = 8;

struct Levers {
  FixedVector<uint32_t, kMostLevers> indices;  // of correspondences
  double vaguer = 1;                           // sigma of the camera centre without them, over that with them
};

// `count` at most kMostLevers.  Deletes from the normal equations, one after another, the correspondence whose loss
// costs most (Belsley, Kuh and Welsch, "Regression diagnostics", 1980, chapter 2).
Levers heaviestLevers(Span<const Correspondence> correspondences, const Estimate &estimate, uint32_t count);

}  // namespace sphc
