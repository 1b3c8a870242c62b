// Which observations does a pose rest on most?
#pragma once
#include "runtime/base/deadline.h"
#include "runtime/base/fixed_vector.h"
#include "runtime/base/span.h"
#include "runtime/types/correspondence.h"
#include "runtime/types/estimate.h"

namespace sphc {

constexpr uint32_t kMostHighLeverage = 8;

// High-leverage observations: those whose loss would make the camera centre vaguest.
struct Leverage {
  FixedVector<uint32_t, kMostHighLeverage> indices;  // of correspondences
  double centre_sigma_ratio = 1;                     // sigma of the camera centre without them, over that with them
  bool is_known = true;                              // false where a deadline passed before all were found
};

// `count` at most kMostHighLeverage.  Deletes from the normal equations, one after another, the correspondence
// whose loss costs most (Belsley, Kuh and Welsch, "Regression diagnostics", 1980, chapter 2).
Leverage highestLeverage(Span<const Correspondence> correspondences, const Estimate &estimate, uint32_t count,
                         const Deadline &deadline = {});

}  // namespace sphc
