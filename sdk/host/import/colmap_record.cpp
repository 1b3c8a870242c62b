#include "host/import/colmap_record.h"

#include "host/calibration/colmap_camera.h"
#include "host/cameras/fault.h"

namespace sphc::host {
namespace {

constexpr double kLargest = 1e9;  // coordinates beyond are damage, and squares of them still finite

bool isSane(const Vector3 &v) { return v.allFinite() && v.cwiseAbs().maxCoeff() < kLargest; }

[[noreturn]] void refuseTwice(const std::string &place) {
  refuse("COLMAP model", place, "its number stands there twice; the file is damaged, export the model again");
}

}  // namespace

void addColmapCamera(const std::string &place, uint32_t id, const ColmapCameraModel &kind, uint64_t width,
                     uint64_t height, const std::vector<double> &params, ColmapModel *model) {
  if (width > UINT32_MAX || height > UINT32_MAX)
    refuse("COLMAP model", place, "its width or height is absurd; take the file from COLMAP again");
  const sphc_camera camera =
      colmapCamera(kind, static_cast<uint32_t>(width), static_cast<uint32_t>(height), params);
  sphc_message message = {};
  if (sphc_camera_check(&camera, &message) != SPHC_OK)
    refuse("COLMAP model", place, std::string(message.text) + "; run COLMAP with another camera model");
  if (!model->cameras.emplace(id, camera).second) refuseTwice(place);
}

void addColmapImage(const std::string &place, uint32_t id, const double pose[7], ColmapImage image,
                    ColmapModel *model) {
  const sphc_rigid rigid_c = {{pose[0], pose[1], pose[2], pose[3]}, {pose[4], pose[5], pose[6]}};
  if (!isValidRigid(rigid_c)) refuse("COLMAP model", place, "its pose is none; the file is damaged");
  image.camera_from_model = rigidFromC(rigid_c);
  if (!isSane(image.camera_from_model.translation_m))
    refuse("COLMAP model", place, "lies absurdly far away; the file is damaged");
  for (const Vector2 &pixel : image.keypoints_px)
    if (!pixel.allFinite()) refuse("COLMAP model", place, "has a keypoint that is no number; the file is damaged");
  if (!model->images.emplace(id, std::move(image)).second) refuseTwice(place);
}

void addColmapPoint(const std::string &place, uint64_t id, ColmapPoint point, ColmapModel *model) {
  if (!isSane(point.position)) refuse("COLMAP model", place, "lies absurdly far away; the file is damaged");
  if (!model->points.emplace(id, std::move(point)).second) refuseTwice(place);
}

}  // namespace sphc::host
