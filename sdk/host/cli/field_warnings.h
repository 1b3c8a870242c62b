// What a calibration's cameras do not see, as a warning.
#pragma once
#include <spherecloud/spherecloud.h>

#include <algorithm>
#include <string>
#include <utility>

#include "host/calibration/compare.h"
#include "host/calibration/nearest_camera.h"
#include "host/cli/common/console.h"

namespace sphc::host {

inline bool doesDepthFallOnColor(const sphc_rig &calibration) {
  const auto depths = compareCalibrations(calibration, calibration).depth_to_color;
  return std::any_of(depths.begin(), depths.end(), [](const PixelDifference &depth) { return depth.samples > 0; });
}

inline void warnOfField(const sphc_rig &calibration, const Console &console) {
  bool is_doubted = false;
  for (const auto &[name, camera] :
       {std::pair("colour", calibration.color_camera), std::pair("depth", calibration.depth_camera)})
    if (const std::string doubt = doubtOfField(camera); !doubt.empty()) {
      console.warn(std::string("Warning: the ") + name + " camera has " + doubt);
      is_doubted = true;
    }
  if (!is_doubted && !doesDepthFallOnColor(calibration))
    console.warn(
        "Warning: no pixel of depth falls on the colour image at 0.5 to 4 m: is t_m of color_from_depth in metres, "
        "is it the way from depth to colour, and are x right, y down and z forward?");
}

}  // namespace sphc::host
