#include "host/cameras/intrinsics.h"

#include <algorithm>

#include "host/cameras/fault.h"
#include "host/cameras/number_text.h"

namespace sphc::host {
namespace {

template <size_t kCount>
sphc_camera makeCamera(sphc_camera_model model, const Intrinsics &in, const std::array<double, kCount> &distortion,
                       uint32_t distortion_count) {
  sphc_camera camera = {model, in.width, in.height, 4 + distortion_count, {in.fx, in.fy, in.cx, in.cy}};
  std::copy_n(distortion.begin(), distortion_count, camera.params + 4);
  return camera;
}

bool isZero(double x) { return x == 0; }

struct RosModel {
  std::string_view name;
  size_t fewest, most;  // coefficients
};
constexpr std::string_view kRosFisheye = "equidistant";
// A RealSense has names of its own.  Its software projects by the last two in the same way, with coefficients that
// differ from Brown's in how tangential and radial distortion multiply.
constexpr RosModel kRosModels[] = {
    {"plumb_bob", 4, 5},     {"rational_polynomial", 8, 8},    {kRosFisheye, 4, 4},
    {"Brown Conrady", 5, 5}, {"Modified Brown Conrady", 5, 5}, {"Inverse Brown Conrady", 5, 5}};

}  // namespace

sphc_camera brownCamera(const Intrinsics &intrinsics, const std::array<double, 8> &distortion) {
  if (!std::all_of(distortion.begin() + 5, distortion.end(), isZero))
    return makeCamera(SPHC_CAMERA_BROWN8, intrinsics, distortion, 8);
  if (!std::all_of(distortion.begin(), distortion.end(), isZero))
    return makeCamera(SPHC_CAMERA_BROWN5, intrinsics, distortion, 5);
  return makeCamera(SPHC_CAMERA_PINHOLE, intrinsics, distortion, 0);
}

sphc_camera fisheyeCamera(const Intrinsics &intrinsics, const std::array<double, 4> &distortion) {
  return makeCamera(SPHC_CAMERA_KANNALA_BRANDT4, intrinsics, distortion, 4);
}

std::string cameraFromOpencv(const Intrinsics &intrinsics, std::vector<double> distortion, bool fisheye,
                             sphc_camera *camera) {
  const size_t count = distortion.size();
  if (fisheye) {
    if (count != 4) return "has " + std::to_string(count) + " numbers; the fisheye model takes 4: k1 k2 k3 k4";
    std::array<double, 4> k;
    std::copy(distortion.begin(), distortion.end(), k.begin());
    *camera = fisheyeCamera(intrinsics, k);
    return {};
  }
  if (count != 0 && count != 4 && count != 5 && count != 8 && count != 12 && count != 14)
    return "has " + std::to_string(count) +
           " numbers; known are 0, 4, 5, 8, 12 and 14: k1 k2 p1 p2 k3 k4 k5 k6 ...";
  distortion.resize(std::max<size_t>(count, 8));
  if (!std::all_of(distortion.begin() + 8, distortion.end(), isZero))
    return "has a thin-prism or tilt part (" + numbersText({distortion.begin() + 8, distortion.end()}) +
           "), which no camera model here has; calibrate without it";
  std::array<double, 8> k;
  std::copy_n(distortion.begin(), 8, k.begin());
  *camera = brownCamera(intrinsics, k);
  return {};
}

std::string cameraFromRos(const Intrinsics &intrinsics, const std::string &model,
                          const std::vector<double> &distortion, sphc_camera *camera) {
  const bool is_fisheye = model == kRosFisheye;
  if (!is_fisheye && std::all_of(distortion.begin(), distortion.end(), isZero)) {
    *camera = brownCamera(intrinsics, {});
    return {};
  }
  for (const RosModel &known : kRosModels)
    if (model == known.name && distortion.size() >= known.fewest && distortion.size() <= known.most)
      return cameraFromOpencv(intrinsics, distortion, is_fisheye, camera);
  return shown(model) + " with " + std::to_string(distortion.size()) +
         " numbers; plumb_bob (4 or 5), rational_polynomial (8) and equidistant (4) are read";
}

std::vector<double> opencvDistortion(const sphc_camera &camera) {
  const uint32_t count = camera.model == SPHC_CAMERA_PINHOLE ? 9 : camera.param_count;
  return {camera.params + 4, camera.params + count};
}

std::string intrinsicsFromMatrix(const std::vector<double> &rows, double shift, Intrinsics *intrinsics) {
  if (rows.size() != 9) return "has " + std::to_string(rows.size()) + " numbers; must be 3 x 3";
  if (rows[1] != 0 || rows[3] != 0 || rows[6] != 0 || rows[7] != 0 || rows[8] != 1)
    return "must be fx 0 cx, 0 fy cy, 0 0 1, but is " + numbersText(rows) +
           "; skew is not supported, calibrate without it";
  intrinsics->fx = rows[0];
  intrinsics->fy = rows[4];
  intrinsics->cx = rows[2] + shift;
  intrinsics->cy = rows[5] + shift;
  return {};
}

std::vector<double> matrixFromCamera(const sphc_camera &camera, double shift) {
  const double *p = camera.params;
  return {p[0], 0, p[2] - shift, 0, p[1], p[3] - shift, 0, 0, 1};
}

bool isFisheye(const sphc_camera &camera) { return camera.model == SPHC_CAMERA_KANNALA_BRANDT4; }

bool hasFourCoefficients(const sphc_camera &camera) {
  return !isFisheye(camera) && std::all_of(camera.params + 8, camera.params + 12, isZero);
}

}  // namespace sphc::host
