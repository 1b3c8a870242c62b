// How far apart two calibrations are, in pixels.
#pragma once
#include <array>

#include "host/recording/calibration.h"

namespace sphc::host {

struct PixelDifference {
  double largest_px = 0, rms_px = 0;
  uint32_t samples = 0;
  uint32_t lost = 0;  // seen by the first, not by the second; not in the two above
};

constexpr std::array<double, 4> kComparedDepthsM = {0.5, 1, 2, 4};

struct CalibrationDifference {
  PixelDifference color, depth;  // of the rays of a grid of pixels
  // Of where pixels of the depth image at these depths fall in the colour image.
  std::array<PixelDifference, kComparedDepthsM.size()> depth_to_color;

  double largestPx() const;
  uint32_t lost() const;
};
CalibrationDifference compareCalibrations(const sphc_rig &first, const sphc_rig &second);

}  // namespace sphc::host
