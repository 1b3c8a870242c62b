#include "host/recording/foreign/ros_camera.h"

#include "host/cameras/intrinsics.h"
#include "host/recording/failure.h"

namespace sphc::recording {

namespace {

// Of a row-major matrix of 3 x `columns`.
host::Intrinsics intrinsicsOf(const RosCameraInfo &info, const double *matrix, int columns) {
  const double *second = matrix + columns;
  return {matrix[0],  second[1],  matrix[2] + host::kZeroCentered, second[2] + host::kZeroCentered,
          info.width, info.height};
}

}  // namespace

sphc_camera rosCamera(const RosCameraInfo &info, bool is_rectified) {
  if (info.binning > 1 || info.offset > 0)
    throw Failure(SPHC_E_ARGUMENT,
                  "its images are binned or a part of the sensor's (binning, roi), which is not read; give a "
                  "calibration file");
  if (is_rectified) return host::brownCamera(intrinsicsOf(info, info.p, 4), {});
  sphc_camera camera;
  const std::string fault =
      host::cameraFromRos(intrinsicsOf(info, info.k, 3), info.distortion_model, info.d, &camera);
  if (!fault.empty())
    throw Failure(SPHC_E_ARGUMENT, "its distortion is of the model " + fault + ": give a calibration file");
  return camera;
}

}  // namespace sphc::recording
