#include "host/calibration/colmap_camera.h"

#include <algorithm>
#include <array>

#include "host/cameras/intrinsics.h"

namespace sphc::host {
namespace {

enum Slot { kSlotF, kSlotFx, kSlotFy, kSlotCx, kSlotCy, kFirstDistortion };  // distortion slots: OpenCV's order

int distortion(int index) { return kFirstDistortion + index; }

const std::vector<ColmapCameraModel> &models() {
  static const std::vector<ColmapCameraModel> kModels = {
      {0, "SIMPLE_PINHOLE", false, {kSlotF, kSlotCx, kSlotCy}},
      {1, "PINHOLE", false, {kSlotFx, kSlotFy, kSlotCx, kSlotCy}},
      {2, "SIMPLE_RADIAL", false, {kSlotF, kSlotCx, kSlotCy, distortion(0)}},
      {3, "RADIAL", false, {kSlotF, kSlotCx, kSlotCy, distortion(0), distortion(1)}},
      {4,
       "OPENCV",
       false,
       {kSlotFx, kSlotFy, kSlotCx, kSlotCy, distortion(0), distortion(1), distortion(2), distortion(3)}},
      {6,
       "FULL_OPENCV",
       false,
       {kSlotFx, kSlotFy, kSlotCx, kSlotCy, distortion(0), distortion(1), distortion(2), distortion(3),
        distortion(4), distortion(5), distortion(6), distortion(7)}},
      {8, "SIMPLE_RADIAL_FISHEYE", true, {kSlotF, kSlotCx, kSlotCy, distortion(0)}},
      {9, "RADIAL_FISHEYE", true, {kSlotF, kSlotCx, kSlotCy, distortion(0), distortion(1)}},
      {5,
       "OPENCV_FISHEYE",
       true,
       {kSlotFx, kSlotFy, kSlotCx, kSlotCy, distortion(0), distortion(1), distortion(2), distortion(3)}}};
  return kModels;
}

template <typename Matches>
const ColmapCameraModel *findColmapModel(const Matches &matches) {
  const auto found = std::find_if(models().begin(), models().end(), matches);
  return found == models().end() ? nullptr : &*found;
}

}  // namespace

const ColmapCameraModel *findColmapModel(int id) {
  return findColmapModel([id](const ColmapCameraModel &model) { return model.id == id; });
}

const ColmapCameraModel *findColmapModel(std::string_view name) {
  return findColmapModel([name](const ColmapCameraModel &model) { return model.name == name; });
}

std::string knownColmapModels() {
  std::string known;
  for (const ColmapCameraModel &model : models()) known += (known.empty() ? "" : ", ") + std::string(model.name);
  return known;
}

sphc_camera colmapCamera(const ColmapCameraModel &model, uint32_t width, uint32_t height,
                         const std::vector<double> &params) {
  std::array<double, kFirstDistortion + 8> values{};
  for (size_t i = 0; i < model.slots.size(); ++i) values[model.slots[i]] = params[i];
  if (model.slots[0] == kSlotF) values[kSlotFx] = values[kSlotFy] = values[kSlotF];
  const Intrinsics intrinsics = {
      values[kSlotFx], values[kSlotFy], values[kSlotCx] + kCornerCentered, values[kSlotCy] + kCornerCentered,
      width,           height};
  const double *k = values.data() + kFirstDistortion;
  return model.fisheye ? fisheyeCamera(intrinsics, {k[0], k[1], k[2], k[3]})
                       : brownCamera(intrinsics, {k[0], k[1], k[2], k[3], k[4], k[5], k[6], k[7]});
}

}  // namespace sphc::host
