#include "host/calibration/compare.h"

#include <algorithm>
#include <cmath>

#include "runtime/geometry/camera.h"
#include "runtime/geometry/rigid.h"

namespace sphc::host {
namespace {

constexpr int kComparedColumns = 65, kComparedRows = 49;

class Tally {
 public:
  void add(bool seen, const Vector2 &a, const Vector2 &b) {
    if (!seen) {
      ++result_.lost;
      return;
    }
    const double squared = (a - b).squaredNorm();
    ++result_.samples;
    sum_ += squared;
    result_.largest_px = std::max(result_.largest_px, std::sqrt(squared));
  }
  PixelDifference result() const {
    PixelDifference result = result_;
    if (result.samples > 0) result.rms_px = std::sqrt(sum_ / result.samples);
    return result;
  }

 private:
  PixelDifference result_;
  double sum_ = 0;
};

// Centres of pixels, corner to corner.
template <typename Visit>
void overGrid(const Camera &camera, Visit visit) {
  for (int row = 0; row < kComparedRows; ++row) {
    for (int column = 0; column < kComparedColumns; ++column) {
      visit(Vector2(0.5 + column * (camera.width() - 1.0) / (kComparedColumns - 1),
                    0.5 + row * (camera.height() - 1.0) / (kComparedRows - 1)));
    }
  }
}

bool isInside(const Vector2 &pixel, const Camera &camera) {
  return pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() <= camera.width() && pixel.y() <= camera.height();
}

PixelDifference compareCameras(const Camera &first, const Camera &second) {
  Tally tally;
  overGrid(first, [&](const Vector2 &pixel) {
    Vector2 ray, again;
    if (first.unproject(pixel, &ray)) tally.add(second.project({ray.x(), ray.y(), 1}, &again), pixel, again);
  });
  return tally.result();
}

struct DepthToColor {
  Camera color, depth;
  Rigid color_from_depth;

  explicit DepthToColor(const sphc_rig &c)
      : color(c.color_camera), depth(c.depth_camera), color_from_depth(rigidFromC(c.color_from_depth)) {}

  bool project(const Vector2 &depth_px, double z_m, Vector2 *color_px) const {
    Vector2 ray;
    return depth.unproject(depth_px, &ray) &&
           color.project(color_from_depth * (z_m * Vector3(ray.x(), ray.y(), 1)), color_px);
  }
};

PixelDifference compareDepthToColor(const DepthToColor &first, const DepthToColor &second, double z_m) {
  Tally tally;
  overGrid(first.depth, [&](const Vector2 &pixel) {
    Vector2 a, b;
    if (!first.project(pixel, z_m, &a) || !isInside(a, first.color)) return;
    tally.add(second.project(pixel, z_m, &b), a, b);
  });
  return tally.result();
}

}  // namespace

double CalibrationDifference::largestPx() const {
  double largest = std::max(color.largest_px, depth.largest_px);
  for (const PixelDifference &difference : depth_to_color) largest = std::max(largest, difference.largest_px);
  return largest;
}

uint32_t CalibrationDifference::lost() const {
  uint32_t sum = color.lost + depth.lost;
  for (const PixelDifference &difference : depth_to_color) sum += difference.lost;
  return sum;
}

CalibrationDifference compareCalibrations(const sphc_rig &first, const sphc_rig &second) {
  const DepthToColor a(first), b(second);
  CalibrationDifference result;
  result.color = compareCameras(a.color, b.color);
  result.depth = compareCameras(a.depth, b.depth);
  for (size_t i = 0; i < kComparedDepthsM.size(); ++i)
    result.depth_to_color[i] = compareDepthToColor(a, b, kComparedDepthsM[i]);
  return result;
}

}  // namespace sphc::host
