// What the files of a COLMAP model say, checked: of 3.8 and of 4.x, binary and text.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "runtime/geometry/rigid.h"

namespace sphc::host {

// Positions and translations are in COLMAP's world and unit, which are arbitrary.
struct ColmapImage {
  std::string name;  // relative to the folder of images
  uint32_t camera = 0;
  Rigid camera_from_model;
  std::vector<Vector2> keypoints_px;
};

struct ColmapObservation {
  uint32_t image, keypoint;
};

struct ColmapPoint {
  Vector3 position = Vector3::Zero();
  std::vector<ColmapObservation> track;
};

struct ColmapModel {
  std::map<uint32_t, sphc_camera> cameras;
  std::map<uint32_t, ColmapImage> images;
  std::map<uint64_t, ColmapPoint> points;
};

// Contents.  Poses stand in the images' file in every version; those of rigs and frames say the same.
struct ColmapFiles {
  bool binary = true;
  std::string cameras, images, points;
};
// Binary ones where there are both, as COLMAP does.
ColmapFiles readColmapFiles(const std::string &folder);
// Every camera passes sphc_camera_check, every number is finite, every link leads somewhere, no name leaves the
// folder of images. Throws std::runtime_error: file, place, cause and cure.
ColmapModel parseColmapModel(const ColmapFiles &files);

// The two formats; links are not checked yet.
ColmapModel parseColmapBinary(const ColmapFiles &files);
ColmapModel parseColmapText(const ColmapFiles &files);

}  // namespace sphc::host
