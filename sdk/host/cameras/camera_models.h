// Camera models by name, and the sizes that an image can have.
#pragma once

#include <spherecloud/spherecloud.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace sphc::host {

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

// A width or height that a camera can have, and what to say of another.
bool isImageSide(double value);
std::string imageSideCure();

}  // namespace sphc::host
