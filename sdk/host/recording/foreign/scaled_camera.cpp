#include "host/recording/foreign/scaled_camera.h"

#include <cmath>

#include "host/recording/calibration_json.h"
#include "host/recording/failure.h"
#include "host/recording/pixels.h"

namespace sphc::recording {

sphc_rig oneCameraRig(const std::array<double, 4> &params, const ImageSize &color, const ImageSize &depth,
                      const std::string &name) {
  // 1 % is a pixel in a hundred, more than rounding of sizes makes and less than any other shape of a screen.
  const double x_scale = static_cast<double>(depth.width) / color.width;
  const double y_scale = static_cast<double>(depth.height) / color.height;
  if (!(std::abs(x_scale / y_scale - 1) < 0.01))
    throw Failure(SPHC_E_IMAGE, name + ": depth of " + sizeText(depth.width, depth.height) + " and colour of " +
                                    sizeText(color.width, color.height) +
                                    " are not of one shape; give the colour images as they were recorded, neither "
                                    "turned nor cropped");
  sphc_rig rig;
  sphc_rig_init(&rig);
  rig.color_camera = {
      SPHC_CAMERA_PINHOLE, color.width, color.height, 4, {params[0], params[1], params[2], params[3]}};
  rig.depth_camera = {SPHC_CAMERA_PINHOLE,
                      depth.width,
                      depth.height,
                      4,
                      {params[0] * x_scale, params[1] * y_scale, params[2] * x_scale, params[3] * y_scale}};
  rig.depth_unit_m = 0.001;
  try {
    return requireGood(rig);
  } catch (const Failure &failure) {
    throw Failure(failure.status(), name + ", its camera: " + failure.what());
  }
}

}  // namespace sphc::recording
