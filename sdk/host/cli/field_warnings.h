// What a calibration's cameras do not see, as a warning.
#pragma once
#include <spherecloud/spherecloud.h>

#include <string>
#include <utility>

#include "host/calibration/nearest_camera.h"
#include "host/cli/common/console.h"

namespace sphc::host {

inline void warnOfField(const sphc_rig &calibration, const Console &console) {
  for (const auto &[name, camera] :
       {std::pair("colour", calibration.color_camera), std::pair("depth", calibration.depth_camera)})
    if (const std::string doubt = doubtOfField(camera); !doubt.empty())
      console.warn(std::string("Warning: the ") + name + " camera has " + doubt);
}

}  // namespace sphc::host
