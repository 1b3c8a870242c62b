#include "runtime/stages/align/depth_patch.h"

#include "runtime/base/elementary.h"
#include "runtime/stages/align/kernels.h"

namespace sphc {
namespace {

constexpr float kFewest = 5;
constexpr float kFarthestAnchor2 = 2.3f;  // squared pixels
constexpr float kFarthestFit = 0.05f;     // of the plane from the anchor, relative
// A little pull towards a frontal plane keeps thin sets of samples from tilting wildly.
constexpr float kPull = 2;

using PatchCopy = uint16_t[kFitSide][kFitLanes];

// Points `patch` at the measurements around pixel (cx, cy): in the image, or at a copy where some lie outside.
void aim(ImageView<uint16_t> depth, int cx, int cy, PatchView *patch, PatchCopy copy) {
  const int left = cx - kFitRadius, top = cy - kFitRadius;
  if (left >= 0 && top >= 0 && left + kFitLanes <= depth.width && top + kFitSide <= depth.height) {
    for (int r = 0; r < kFitSide; ++r) patch->rows[r] = depth.row(top + r) + left;
    return;
  }
  for (int r = 0; r < kFitSide; ++r) {
    patch->rows[r] = copy[r];
    for (int l = 0; l < kFitLanes; ++l) {
      const int u = left + l, v = top + r;
      const bool inside = u >= 0 && v >= 0 && u < depth.width && v < depth.height;
      copy[r][l] = inside ? depth.row(v)[u] : uint16_t{0};
    }
  }
}

// The valid measurement nearest to the point asked for; 0: none near enough.
float findAnchor(const PatchView &patch) {
  const auto valid = [&patch](float raw) { return raw >= patch.low && raw <= patch.high; };
  const float middle = static_cast<float>(patch.rows[kFitRadius][kFitRadius]);
  if (valid(middle)) return middle;
  float nearest2 = kFarthestAnchor2, anchor = 0;
  for (int r = 0; r < kFitSide; ++r) {
    for (int l = 0; l < kFitSide; ++l) {
      const float x = static_cast<float>(l - kFitRadius) - patch.dx;
      const float y = static_cast<float>(r - kFitRadius) - patch.dy;
      const float distance2 = x * x + y * y, raw = static_cast<float>(patch.rows[r][l]);
      if (valid(raw) && distance2 < nearest2) nearest2 = distance2, anchor = raw;
    }
  }
  return anchor;
}

struct Plane {  // q = a + b u + c v
  float a, b, c;
};

// Least squares with the pull on b and c: the mean out first, then two equations.
Plane fit(const PatchSums &s) {
  const float inverse_n = 1 / s.n;
  const float uu = s.uu + kPull - s.u * s.u * inverse_n, vv = s.vv + kPull - s.v * s.v * inverse_n;
  const float uv = s.uv - s.u * s.v * inverse_n;
  const float qu = s.qu - s.q * s.u * inverse_n, qv = s.qv - s.q * s.v * inverse_n;
  const float scale = 1 / (uu * vv - uv * uv);  // the pull keeps it from zero
  Plane plane;
  plane.b = (vv * qu - uv * qv) * scale;
  plane.c = (uu * qv - uv * qu) * scale;
  plane.a = (s.q - plane.b * s.u - plane.c * s.v) * inverse_n;
  return plane;
}

float meanSquare(const PatchSums &s, const Plane &p) {
  const float linear = p.a * s.q + p.b * s.qu + p.c * s.qv;
  const float square = p.a * p.a * s.n + p.b * p.b * s.uu + p.c * p.c * s.vv +
                       2 * (p.a * p.b * s.u + p.a * p.c * s.v + p.b * p.c * s.uv);
  const float sum = s.qq - 2 * linear + square;
  return sum > 0 ? sum / s.n : 0;
}

}  // namespace

PatchDepth patchDepth(ImageView<uint16_t> depth, const DepthSensor &sensor, double x, double y) {
  const int cx = static_cast<int>(floorOf(x + 0.5)), cy = static_cast<int>(floorOf(y + 0.5));
  PatchView patch;
  PatchCopy copy;
  aim(depth, cx, cy, &patch, copy);
  patch.low = static_cast<float>(sensor.min_m / sensor.unit_m);
  if (!(patch.low >= 1)) patch.low = 1;  // 0 is no measurement
  patch.high = static_cast<float>(sensor.max_m / sensor.unit_m);
  patch.dx = static_cast<float>(x - cx);
  patch.dy = static_cast<float>(y - cy);
  patch.anchor = findAnchor(patch);
  if (!(patch.anchor > 0)) return {};
  PatchSums sums;
  simdAlignKernels().patch_sums(patch, &sums);
  if (sums.n < kFewest) return {};
  const Plane plane = fit(sums);
  const float here = plane.a + plane.b * patch.dx + plane.c * patch.dy;
  if (!(absOf(here) <= kFarthestFit)) return {};

  const double anchor_m = static_cast<double>(patch.anchor) * sensor.unit_m;
  const double z = anchor_m / (1 + static_cast<double>(here));
  const double scatter = static_cast<double>(sqrtOf(meanSquare(sums, plane))) * z * z / anchor_m;
  // Few pixels of one surface: an edge runs through, and the keypoint may belong to either side.
  const double edge = 1 + 2 * (1 - static_cast<double>(sums.n) / (kFitSide * kFitSide));
  const double model = sensor.sigmaAt(z);
  return {z, edge * (scatter > model ? scatter : model)};
}

}  // namespace sphc
