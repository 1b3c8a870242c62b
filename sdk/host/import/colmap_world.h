// Metres and up for a COLMAP model, which knows neither.
#pragma once
#include "host/import/colmap_import.h"
#include "host/import/colmap_model.h"

namespace sphc::host {

// Down in the model's world when its cameras were held level, more or less (upright.h).
Vector3 downByCameras(const ColmapModel &model);

struct ColmapScale {
  double metres_per_unit = 0, spread = 0;  // relative, 1 sigma of an image's own scale
};
// By depth images of the model's points.  `depth`: their folder; `calibration`: a file, or empty where depth images
// lie on the colour images and are in millimetres.
ColmapScale scaleByDepth(const ColmapModel &model, const std::string &depth, const std::string &calibration);

}  // namespace sphc::host
