// From what the files tell to the one calibration of a colour and a depth camera.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "host/cameras/part.h"

namespace sphc::host {

struct ImageSize {
  uint32_t width = 0, height = 0;  // 0: as the file says
};

// What the files may leave open.
struct JoinOptions {
  std::string color, depth;  // names of cameras; empty: those called so, or the first and the second
  ImageSize color_size, depth_size;
  std::optional<sphc_rigid> color_from_depth;
  std::optional<double> depth_unit_m;
  bool registered = false;   // there is one camera: depth lies on colour already
  bool approximate = false;  // take a camera that is only near to the file's
};

// Throws std::runtime_error with cause and cure.
sphc_rig joinParts(const std::vector<CalibrationPart> &parts, const JoinOptions &options);

}  // namespace sphc::host
