// What one calibration file tells, in our conventions: pixel centres at 0.5, metres, target_from_source.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "spherecloud/spherecloud.h"

namespace sphc::host {

struct TextFile {
  std::string name, text;
};

// How a sensor's whole image becomes a smaller one: scaled, then cut.
struct ImageMode {
  uint32_t scaled_width, scaled_height, crop_x, crop_y, width, height;
};

struct NamedCamera {
  std::string name;
  sphc_camera camera = {};                    // width 0: the file does not say the size
  std::optional<sphc_rigid> camera_from_rig;  // one rig a file
  std::vector<ImageMode> modes;               // other sizes that the sensor gives
  std::string inexact;  // why `camera` is only near to what the file says; empty: it is the same
};

struct CalibrationPart {
  std::vector<NamedCamera> cameras;
  std::optional<sphc_rigid> second_from_first;  // of the cameras of all files, in their order
  std::optional<double> depth_unit_m;
};

}  // namespace sphc::host
