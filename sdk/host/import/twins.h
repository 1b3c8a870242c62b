// Near-duplicate points, which would give each other away.
#pragma once
#include <vector>

#include "host/import/point_model.h"

namespace sphc::host {

// Keeps of each group of twins (within 1.5 cm, and alike) the one seen most often.
std::vector<ModelPoint> withoutTwins(std::vector<ModelPoint> points);

}  // namespace sphc::host
