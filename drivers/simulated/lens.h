// lens.h - the two camera models of this headset, both ways, and tables of rays.
#pragma once

#include <vector>

#include "spherecloud/spherecloud.h"

namespace sphc::simulated {

struct Ray2 {
  float x, y;  // the ray is (x, y, 1) in camera coordinates
};

// BROWN5 and KANNALA_BRANDT4 only.
// Pixel of the point (x, y, 1).
void project(const sphc_camera &camera, double x, double y, double pixel_px[2]);
// The (x, y, 1) that projects to a pixel; by Newton's method on `project`.
void unproject(const sphc_camera &camera, const double pixel_px[2], double xy[2]);

// Rays of the pixel centres, with one column and one row to spare, so that the step to the next pixel is always
// there.
class RayTable {
 public:
  explicit RayTable(const sphc_camera &camera);
  // Ray of the pixel centre (column + 0.5, row + 0.5) displaced by (dx, dy) pixels.
  Ray2 at(uint32_t column, uint32_t row, float dx, float dy) const {
    const Ray2 &a = rays_[row * stride_ + column], &b = rays_[row * stride_ + column + 1];
    const Ray2 &c = rays_[(row + 1) * stride_ + column];
    return {a.x + (b.x - a.x) * dx + (c.x - a.x) * dy, a.y + (b.y - a.y) * dx + (c.y - a.y) * dy};
  }
  const Ray2 &center(uint32_t column, uint32_t row) const { return rays_[row * stride_ + column]; }

 private:
  uint32_t stride_;
  std::vector<Ray2> rays_;
};

}  // namespace sphc::simulated
