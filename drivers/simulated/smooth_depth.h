// smooth_depth.h - depth as telephones give it.
#pragma once

#include <cstdint>

namespace sphc::simulated {

// The mean of the measured pixels of each 5 x 5 window: small holes are filled, and edges become ramps.
void smoothDepth(uint32_t width, uint32_t height, uint16_t *depth);

}  // namespace sphc::simulated
