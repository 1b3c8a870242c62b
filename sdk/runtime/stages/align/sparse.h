// Depth of single colour pixels, from a depth image of another camera.
#pragma once
#include "runtime/geometry/camera.h"
#include "runtime/geometry/rigid.h"
#include "runtime/stages/align/depth_patch.h"
#include "runtime/types/depth_sensor.h"
#include "runtime/types/image_view.h"

namespace sphc {

class SparseAligner {
 public:
  SparseAligner() = default;
  SparseAligner(const Camera &color, const Camera &depth, const Rigid &color_from_depth, const DepthSensor &sensor);

  // Point seen at a colour pixel, in the colour camera's frame, and 1 sigma of its z; false where the depth camera
  // has no answer: a hole, out of its view, or hidden from it behind something nearer.
  bool lift(ImageView<uint16_t> depth, const Vector2 &color_pixel_px, Vector3 *point_m, double *sigma_m) const;
  // Unit bearing of a colour pixel; false where the camera's distortion has none.
  bool bearing(const Vector2 &color_pixel_px, Vector3 *bearing) const;

 private:
  bool findSurface(ImageView<uint16_t> depth, const Vector2 &ray, Vector2 *depth_pixel_px) const;

  Camera color_, depth_;
  Rigid depth_from_color_;
  DepthSensor sensor_ = {};
  bool registered_ = false;  // the two images share one pixel grid
};

}  // namespace sphc
