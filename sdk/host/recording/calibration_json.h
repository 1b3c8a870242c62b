// The calibration file's text.
#pragma once

#include <string>
#include <string_view>

#include "calibration.h"

namespace sphc::replay {

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

// Throws Failure; its text begins with the key.
sphc_calibration calibrationFromJson(std::string_view text);
std::string calibrationToJson(const sphc_calibration &calibration);

}  // namespace sphc::replay
