// Is a pose to be believed?
#pragma once
#include "runtime/types/estimate.h"
#include "spherecloud/spherecloud.h"

namespace sphc {

// `matches`: found by looking near the pose's own predictions, of which `estimate.inliers` agree with it.
sphc_outcome judgePose(const Estimate &estimate, uint32_t matches, uint32_t min_inliers);

}  // namespace sphc
