#include "host/cameras/camera_models.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace sphc::host {
namespace {

constexpr ModelName kModels[] = {
    {SPHC_CAMERA_PINHOLE, "pinhole", 4, "fx fy cx cy"},
    {SPHC_CAMERA_BROWN5, "brown5", 9, "fx fy cx cy k1 k2 p1 p2 k3"},
    {SPHC_CAMERA_BROWN8, "brown8", 12, "fx fy cx cy k1 k2 p1 p2 k3 k4 k5 k6"},
    {SPHC_CAMERA_KANNALA_BRANDT4, "kannala_brandt4", 8, "fx fy cx cy k1 k2 k3 k4"},
};

}  // namespace

const ModelName *findModel(sphc_camera_model model) {
  const auto it =
      std::find_if(std::begin(kModels), std::end(kModels), [&](const ModelName &m) { return m.model == model; });
  return it == std::end(kModels) ? nullptr : it;
}

const ModelName *findModel(std::string_view name) {
  const auto it =
      std::find_if(std::begin(kModels), std::end(kModels), [&](const ModelName &m) { return m.name == name; });
  return it == std::end(kModels) ? nullptr : it;
}

std::string modelNames() {
  std::string names;
  for (const ModelName &model : kModels) names += (names.empty() ? "" : ", ") + std::string(model.name);
  return names;
}

bool isImageSide(double value) {
  return value >= SPHC_CAMERA_MIN_PX && value <= SPHC_CAMERA_MAX_PX && value == std::floor(value);
}

std::string imageSideCure() {
  return "must be a whole number from " + std::to_string(SPHC_CAMERA_MIN_PX) + " to " +
         std::to_string(SPHC_CAMERA_MAX_PX);
}

}  // namespace sphc::host
