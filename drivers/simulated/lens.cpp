#include "drivers/simulated/lens.h"

#include <cmath>

namespace sphc::simulated {
namespace {

void distortBrown(const double *k, double x, double y, double out[2]) {
  const double r2 = x * x + y * y;
  const double radial = 1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
  out[0] = x * radial + 2 * k[2] * x * y + k[3] * (r2 + 2 * x * x);
  out[1] = y * radial + k[2] * (r2 + 2 * y * y) + 2 * k[3] * x * y;
}

void distortFisheye(const double *k, double x, double y, double out[2]) {
  const double r = std::sqrt(x * x + y * y);
  const double theta = std::atan(r);
  const double t2 = theta * theta;
  const double bent = theta * (1 + t2 * (k[0] + t2 * (k[1] + t2 * (k[2] + t2 * k[3]))));
  const double scale = r > 1e-9 ? bent / r : 1.0;
  out[0] = x * scale;
  out[1] = y * scale;
}

}  // namespace

void project(const sphc_camera &camera, double x, double y, double pixel_px[2]) {
  double bent[2];
  if (camera.model == SPHC_CAMERA_BROWN5) {
    distortBrown(camera.params + 4, x, y, bent);
  } else {
    distortFisheye(camera.params + 4, x, y, bent);
  }
  pixel_px[0] = camera.params[0] * bent[0] + camera.params[2];
  pixel_px[1] = camera.params[1] * bent[1] + camera.params[3];
}

void unproject(const sphc_camera &camera, const double pixel_px[2], double xy[2]) {
  constexpr int kSteps = 12;
  constexpr double kStep = 1e-6, kDonePixels = 1e-9;
  double x = (pixel_px[0] - camera.params[2]) / camera.params[0];
  double y = (pixel_px[1] - camera.params[3]) / camera.params[1];
  for (int i = 0; i < kSteps; ++i) {
    double at[2], dx[2], dy[2];
    project(camera, x, y, at);
    const double ex = pixel_px[0] - at[0], ey = pixel_px[1] - at[1];
    if (ex * ex + ey * ey < kDonePixels * kDonePixels) break;
    project(camera, x + kStep, y, dx);
    project(camera, x, y + kStep, dy);
    const double a = (dx[0] - at[0]) / kStep, b = (dy[0] - at[0]) / kStep;
    const double c = (dx[1] - at[1]) / kStep, d = (dy[1] - at[1]) / kStep;
    const double determinant = a * d - b * c;
    x += (d * ex - b * ey) / determinant;
    y += (a * ey - c * ex) / determinant;
  }
  xy[0] = x;
  xy[1] = y;
}

RayTable::RayTable(const sphc_camera &camera) : stride_(camera.width + 1) {
  rays_.reserve(static_cast<size_t>(stride_) * (camera.height + 1));
  for (uint32_t row = 0; row <= camera.height; ++row) {
    for (uint32_t column = 0; column <= camera.width; ++column) {
      const double pixel_px[2] = {column + 0.5, row + 0.5};
      double xy[2];
      unproject(camera, pixel_px, xy);
      rays_.push_back({static_cast<float>(xy[0]), static_cast<float>(xy[1])});
    }
  }
}

}  // namespace sphc::simulated
