// One camera, image or point of a COLMAP model, whichever way it was written; refuses what no model can hold.
#pragma once
#include <string>
#include <string_view>

#include "host/calibration/colmap_camera.h"
#include "host/import/colmap_model.h"

namespace sphc::host {

// `place` is where it stands, for messages.
void addColmapCamera(const std::string &place, uint32_t id, const ColmapCameraModel &kind, uint64_t width,
                     uint64_t height, const std::vector<double> &params, ColmapModel *model);
// `pose`: camera_from_model as QW QX QY QZ TX TY TZ.
void addColmapImage(const std::string &place, uint32_t id, const double pose[7], ColmapImage image,
                    ColmapModel *model);
void addColmapPoint(const std::string &place, uint64_t id, ColmapPoint point, ColmapModel *model);

}  // namespace sphc::host
