// The library's estimators as variants to measure.  Everything that touches their interface is in ours.cpp.
#pragma once
#include "lab/pose/variant.h"
#include "runtime/types/depth_calibration.h"

namespace sphc::host {

// What is believed of a sensor's bias before its first frame.
DepthCalibration sensorPrior(DepthSource source);

// Each with memory of its own, taken before the clock starts.
std::vector<PoseVariant> ourVariants();

}  // namespace sphc::host
