#include "runtime/stages/align/depth_patch.h"

#include <Eigen/Cholesky>

#include "runtime/base/fixed_vector.h"
#include "runtime/geometry/rotation.h"

namespace sphc {
namespace {

constexpr int kRadius = 2, kSide = 2 * kRadius + 1;
constexpr double kSameSurface = 0.025;  // relative depth difference a pixel away that still is one surface
constexpr size_t kFewest = 5;

struct Sample {
  double dx, dy;     // from the pixel asked for
  double inverse_m;  // 1 / depth
};

}  // namespace

PatchDepth patchDepth(ImageView<uint16_t> depth, const DepthSensor &sensor, double x, double y) {
  FixedVector<Sample, kSide * kSide> valid;
  const int cx = static_cast<int>(floorOf(x + 0.5)), cy = static_cast<int>(floorOf(y + 0.5));
  double nearest2 = 1e9, anchor = 0;
  for (int v = cy - kRadius; v <= cy + kRadius; ++v) {
    for (int u = cx - kRadius; u <= cx + kRadius; ++u) {
      if (u < 0 || v < 0 || u >= depth.width || v >= depth.height) continue;
      const double z = depth.row(v)[u] * sensor.unit_m;
      if (!(z >= sensor.min_m && z <= sensor.max_m)) continue;
      const Sample s = {u - x, v - y, 1 / z};
      valid.push(s);
      const double distance2 = s.dx * s.dx + s.dy * s.dy;
      if (distance2 < nearest2) nearest2 = distance2, anchor = s.inverse_m;
    }
  }
  if (valid.size() < kFewest || nearest2 > 2.3) return {};

  Matrix3 normal = Matrix3::Zero();
  Vector3 right = Vector3::Zero();
  FixedVector<Sample, kSide * kSide> surface;
  for (const Sample &s : valid) {
    const double pixels = 1 + (absOf(s.dx) > absOf(s.dy) ? absOf(s.dx) : absOf(s.dy));
    if (absOf(s.inverse_m / anchor - 1) > kSameSurface * pixels) continue;
    surface.push(s);
    const Vector3 row(1, s.dx, s.dy);
    normal += row * row.transpose();
    right += s.inverse_m * row;
  }
  if (surface.size() < kFewest) return {};
  // A little pull towards a frontal plane keeps thin sets of samples from tilting wildly.
  normal(1, 1) += 2;
  normal(2, 2) += 2;
  const Vector3 plane = normal.ldlt().solve(right);
  if (!(plane[0] > 0) || absOf(plane[0] / anchor - 1) > 2 * kSameSurface) return {};

  double squares = 0;
  for (const Sample &s : surface) {
    const double error = s.inverse_m - plane.dot(Vector3(1, s.dx, s.dy));
    squares += error * error;
  }
  const double z = 1 / plane[0];
  const double scatter = sqrtOf(squares / static_cast<double>(surface.size())) * z * z;
  // Few pixels of one surface: an edge runs through, and the keypoint may belong to either side.
  const double edge = 1 + 2 * (1 - static_cast<double>(surface.size()) / static_cast<double>(kSide * kSide));
  const double model = sensor.sigmaAt(z);
  return {z, edge * (scatter > model ? scatter : model)};
}

}  // namespace sphc
