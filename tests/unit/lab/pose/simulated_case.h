// Cases with a pose that can be found.
#pragma once
#include "lab/pose/case.h"
#include "runtime/base/random.h"

namespace sphc::host::test {

// Points in view of an ordinary camera; one row in `one_true_in` is true.
inline PoseCase simulatedCase(size_t rows, size_t one_true_in) {
  Random random(1);
  const auto uniform = [&random](double low, double high) { return low + (high - low) * random.uniform(); };
  PoseCase c;
  c.name = "simulated";
  c.eta_percent = static_cast<uint32_t>(100 / one_true_in);
  c.camera = {500, 500, 320, 240, 640, 480};
  c.truth_camera_from_map.rotation = rotationFromVector({0.3, -0.5, 0.2});
  c.truth_camera_from_map.translation_m = {0.2, 0.1, 2.2};
  for (size_t i = 0; i < rows; ++i) {
    const Vector2 pixel(uniform(0, 640), uniform(0, 480));
    const LiftedPoint lifted = liftPixel(c.camera, pixel, uniform(0.8, 4), {});
    const Vector3 point = c.truth_camera_from_map.inverse() * lifted.point_m;
    const Vector3 fake = Vector3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)).normalized();
    c.is_true.push_back(i % one_true_in == 0);
    c.correspondences.push_back({lifted, c.is_true.back() ? point.normalized() : fake});
    c.true_pixels_px.push_back(pixel);
    c.true_points_map_m.push_back(point);
  }
  return c;
}

}  // namespace sphc::host::test
