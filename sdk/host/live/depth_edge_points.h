// Where something near hides something far in a depth image, found at its own resolution.
#pragma once
#include <cstdint>
#include <vector>

namespace sphc::host {

struct DepthEdgePoint {
  double x_px, y_px;  // half of the way from near to far; centre of the top-left pixel (0.5, 0.5)
  uint16_t near;      // depth where the rise begins
};

// Of two pixels, with a hole between near and far, or smoothed to a ramp.  Across and down, both ways; the far side
// is at least 10 % farther, and each pixel of the ramp by more than floors of rooms rise in a camera of this focal
// length, which is 4 % or more.
std::vector<DepthEdgePoint> depthEdgePoints(const std::vector<uint16_t> &depth, uint32_t width, uint32_t height,
                                            double focal_px);

}  // namespace sphc::host
