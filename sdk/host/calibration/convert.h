// Calibration files: reading whatever format, and making a calibration fit the one wanted.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "host/calibration/formats.h"
#include "host/cameras/join.h"

namespace sphc::host {

struct ReadFile {
  std::string path;
  Format format;
};
struct ReadCalibration {
  sphc_rig calibration;
  std::vector<ReadFile> files;
};
// A folder stands for COLMAP's cameras.txt in it, or for the files that writeCalibration makes for ROS, where it
// has not both.  `format`: of all files but the one of ROS's that is OpenCV's; none: each tells by itself.
ReadCalibration readCalibrationFiles(const std::vector<std::string> &paths, std::optional<Format> format,
                                     const JoinOptions &options);

// The calibration with cameras that the format holds.  Where it does not hold one: throws, or with `approximate`
// takes the nearest that it holds.
sphc_rig fitToFormat(const sphc_rig &calibration, Format format, bool approximate);

}  // namespace sphc::host
