// The calibration file and its text.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "calibration.h"

namespace sphc::recording {

struct ModelName {
  sphc_camera_model model;
  const char *name;
  uint32_t param_count;
  const char *params;
};
// Null when there is none.
const ModelName *findModel(sphc_camera_model model);
const ModelName *findModel(std::string_view name);
// "pinhole, brown5, ..."
std::string modelNames();

// What is wrong with it and how to cure it, as "key: text"; empty when nothing is.
std::string calibrationFault(const sphc_calibration &calibration);

// Throw Failure with the file's name.  What is written reads back to the bit.
sphc_calibration readCalibration(const std::filesystem::path &path);
void writeCalibration(const std::filesystem::path &path, const sphc_calibration &calibration);

// Throws Failure; its text begins with the key.
sphc_calibration calibrationFromJson(std::string_view text);
std::string calibrationToJson(const sphc_calibration &calibration);

}  // namespace sphc::recording
