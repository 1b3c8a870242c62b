#include "host/calibration/rational6kt.h"

#include "host/calibration/nearest_camera.h"
#include "host/cameras/number_text.h"

namespace sphc::host {
namespace {

// As OpenCV's rational model but for half the tangential cross terms.
Vector2 projectRational6kt(const sphc_camera &brown8, const Vector2 &ray) {
  const double *k = brown8.params + 4;
  const double x = ray.x(), y = ray.y(), r2 = x * x + y * y, p1 = k[2], p2 = k[3];
  const double radial = (1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]))) / (1 + r2 * (k[5] + r2 * (k[6] + r2 * k[7])));
  const double u = x * radial + p2 * (r2 + 2 * x * x) + p1 * x * y;
  const double v = y * radial + p1 * (r2 + 2 * y * y) + p2 * x * y;
  return {brown8.params[0] * u + brown8.params[2], brown8.params[1] * v + brown8.params[3]};
}

void approximate(NamedCamera *named) {
  sphc_camera brown8 = named->camera;
  brown8.model = SPHC_CAMERA_BROWN8;
  brown8.param_count = 12;
  std::vector<RaySample> samples = sampleCamera(brown8);
  if (samples.empty()) return;
  for (RaySample &sample : samples) sample.pixel_px = projectRational6kt(brown8, sample.ray);
  const NearestCamera nearest = nearestCamera(samples, {SPHC_CAMERA_BROWN8, 12}, brown8);
  named->camera = nearest.camera;
  named->inexact += "; the nearest brown8 is off by up to " + briefText(nearest.largest_px) + " px";
}

}  // namespace

CalibrationPart withNearestCameras(CalibrationPart part) {
  for (NamedCamera &named : part.cameras)
    if (!named.inexact.empty()) approximate(&named);
  return part;
}

}  // namespace sphc::host
