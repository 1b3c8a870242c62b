// COLMAP's camera models, to the C interface's.  COLMAP's principal points are ours: pixel centres at 0.5.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "spherecloud/spherecloud.h"

namespace sphc::host {

struct ColmapCameraModel {
  int id;  // in binary files
  const char *name;
  bool fisheye;
  std::vector<int> slots;  // what its parameters are
};

// Null for a model that the C interface has none for.
const ColmapCameraModel *findColmapModel(int id);
const ColmapCameraModel *findColmapModel(std::string_view name);
// For messages: all names, with commas.
std::string knownColmapModels();

// As many parameters as the model has slots.
sphc_camera colmapCamera(const ColmapCameraModel &model, uint32_t width, uint32_t height,
                         const std::vector<double> &params);

}  // namespace sphc::host
