// The library's estimators as variants to measure.  Everything that touches their interface is in pose_ours.cpp.
#pragma once
#include "host/bench/pose_variant.h"

namespace sphc::host {

// Each with memory of its own, taken before the clock starts.
std::vector<PoseVariant> ourVariants();

}  // namespace sphc::host
