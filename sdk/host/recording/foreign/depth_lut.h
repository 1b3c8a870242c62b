// A HoloLens' depth camera: a table of the ray of each pixel, and depth along the ray.
#pragma once

#include <spherecloud/spherecloud.h>

#include <vector>

#include "host/recording/image_header.h"

namespace sphc::recording {

// Makes of its images those of a pinhole camera of the same size, with the scale of the middle of the image.
class DepthLut {
 public:
  // Floats pixel by pixel, axes right, down, forward.  Both throw Failure (ARGUMENT) without a name when the file
  // does not fit the size or is no camera.
  // x, y, z of a ray of length 1; z is 0 where there is none.
  static DepthLut ofRays(ByteView file, const ImageSize &size);
  // x, y where the ray meets the plane at 1; not finite where there is none.
  static DepthLut ofPlanePoints(ByteView file, const ImageSize &size);

  const sphc_camera &camera() const { return camera_; }
  // Each pixel is the nearest one of the sensor, along the axis instead of along the ray.
  void toPinhole(const std::vector<uint16_t> &range_mm, uint16_t *depth_mm) const;

 private:
  static constexpr uint32_t kNowhere = UINT32_MAX;
  struct Ray {
    double x, y, z;  // z of the ray of length 1, the others on the plane at 1; z is 0 where there is none
  };
  DepthLut(std::vector<Ray> rays, const ImageSize &size);
  static Ray rayOf(double x, double y, double z);
  void fitCamera();
  uint32_t sourceOf(uint32_t u, uint32_t v) const;

  ImageSize size_;
  std::vector<Ray> rays_;
  sphc_camera camera_;
  std::vector<uint32_t> sources_;  // of each pixel
};

}  // namespace sphc::recording
