// Builds a point model from a COLMAP model: docs/colmap.md.
#pragma once
#include <optional>
#include <string>

#include "host/import/point_model.h"
#include "host/import/rgbd_import.h"

namespace sphc::host {

enum class ColmapDescriptors {
  kAgain,    // the images are described again by the device's own feature stage
  kDatabase  // those of COLMAP's database
};

struct ColmapImportOptions {
  std::string model, images, database;  // folder, folder, file
  ColmapDescriptors descriptors = ColmapDescriptors::kAgain;
  uint32_t max_keypoints = 4000;  // of an image, described again
  uint32_t min_observations = 2;  // images that saw a point
  double reach_px = 2;            // COLMAP's keypoint and ours are one within this
  // The metric scale: given, or from depth images beside the colour images (docs/colmap.md).
  std::optional<double> metres_per_unit;
  std::string depth, calibration;
  // Down in COLMAP's world; nothing: the cameras are taken to have been held level.  Zero: axes stay.
  std::optional<Vector3> gravity;
};

struct ColmapImportSummary {
  uint32_t images = 0, points_of_model = 0, points_described = 0, points_kept = 0;
  double metres_per_unit = 0;
  double scale_spread = 0;  // of the images' own scales, 1 sigma, relative; 0: the scale was given
  Matrix3 world_from_model_axes = Matrix3::Identity();  // x_world = metres_per_unit axes x_model
};

// Throws std::runtime_error with cause and cure.
PointModel importColmap(const ColmapImportOptions &options, const Progress &progress, ColmapImportSummary *summary);

}  // namespace sphc::host
