#include "host/recording/foreign/ros_camera.h"

#include <algorithm>

#include "host/recording/failure.h"

namespace sphc::recording {

namespace {

constexpr double kHalfPixel = 0.5;

struct RosModel {
  const char *name;
  sphc_camera_model model;
  size_t fewest, most;  // coefficients
};
// A RealSense has names of its own.  Its software projects by the last two in the same way, with coefficients that
// differ from Brown's in how tangential and radial distortion multiply.
constexpr RosModel kRosModels[] = {{"plumb_bob", SPHC_CAMERA_BROWN5, 4, 5},
                                   {"rational_polynomial", SPHC_CAMERA_BROWN8, 8, 8},
                                   {"equidistant", SPHC_CAMERA_KANNALA_BRANDT4, 4, 4},
                                   {"Brown Conrady", SPHC_CAMERA_BROWN5, 5, 5},
                                   {"Modified Brown Conrady", SPHC_CAMERA_BROWN5, 5, 5},
                                   {"Inverse Brown Conrady", SPHC_CAMERA_BROWN5, 5, 5}};

sphc_camera pinholeOf(const RosCameraInfo &info, double fx, double fy, double cx, double cy) {
  return {SPHC_CAMERA_PINHOLE, info.width, info.height, 4, {fx, fy, cx + kHalfPixel, cy + kHalfPixel}};
}

}  // namespace

sphc_camera rosCamera(const RosCameraInfo &info, bool is_rectified) {
  if (info.binning > 1 || info.offset > 0)
    throw Failure(SPHC_E_ARGUMENT,
                  "its images are binned or a part of the sensor's (binning, roi), which is not read; give a "
                  "calibration file");
  if (is_rectified) return pinholeOf(info, info.p[0], info.p[5], info.p[2], info.p[6]);
  sphc_camera camera = pinholeOf(info, info.k[0], info.k[4], info.k[2], info.k[5]);
  const bool has_none = std::all_of(info.d.begin(), info.d.end(), [](double d) { return d == 0; });
  if (has_none && info.distortion_model != "equidistant") return camera;
  for (const RosModel &known : kRosModels) {
    if (info.distortion_model != known.name) continue;
    if (info.d.size() < known.fewest || info.d.size() > known.most) break;
    camera.model = known.model;
    camera.param_count = static_cast<uint32_t>(4 + known.most);
    std::copy(info.d.begin(), info.d.end(), camera.params + 4);
    return camera;
  }
  throw Failure(SPHC_E_ARGUMENT,
                "its distortion is of the model \"" + info.distortion_model.substr(0, 32) + "\" with " +
                    std::to_string(info.d.size()) +
                    " numbers; plumb_bob (4 or 5), rational_polynomial (8) and equidistant (4) are "
                    "read: give a calibration file");
}

}  // namespace sphc::recording
