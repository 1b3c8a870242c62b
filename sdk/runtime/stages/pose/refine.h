// Robust least squares on the pose: Gauss-Newton with Levenberg damping and the Geman-McClure loss, which lets go
// of outliers altogether (fake directions leak into slower-dying losses).
#pragma once
#include "runtime/base/span.h"
#include "runtime/types/correspondence.h"
#include "runtime/types/estimate.h"

namespace sphc {

struct Refinement {
  Rigid camera_from_map;
  Matrix6 information;  // weighted normal matrix at the result
  double cost;          // sum of the robust losses
};

// `scale2`: squared residual at which a correspondence has lost three quarters of its weight.
Refinement refinePose(Span<const Correspondence> correspondences, const Rigid &start, double scale2,
                      int iterations);

}  // namespace sphc
