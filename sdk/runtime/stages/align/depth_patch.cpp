#include "runtime/stages/align/depth_patch.h"

#include <cstring>

#include "runtime/base/elementary.h"

namespace sphc {
namespace {

constexpr int kRadius = 2, kSide = 2 * kRadius + 1;
constexpr int kLanes = 8;               // a row of the patch, padded; sums run down the lanes, then across
constexpr float kSameSurface = 0.025f;  // relative depth difference a pixel away that still is one surface
constexpr float kFewest = 5;
constexpr float kFarthestAnchor2 = 2.3f;  // squared pixels
// A little pull towards a frontal plane keeps thin sets of samples from tilting wildly.
constexpr float kPull = 2;

// Measurements in sensor units; 0: none.
struct Patch {
  alignas(32) float raw[kSide][kLanes];
};

// Lanes beyond the patch only fill the vector.
bool isInside(int lane) { return lane < kSide; }

Patch loadPatch(ImageView<uint16_t> depth, const DepthSensor &sensor, int left, int top) {
  const float low = static_cast<float>(sensor.min_m / sensor.unit_m);
  const float high = static_cast<float>(sensor.max_m / sensor.unit_m);
  Patch patch;
  for (int r = 0; r < kSide; ++r) {
    uint16_t row[kLanes] = {};
    const int v = top + r;
    if (v >= 0 && v < depth.height) {
      if (left >= 0 && left + kLanes <= depth.width) {
        std::memcpy(row, depth.row(v) + left, sizeof row);
      } else {
        for (int l = 0; l < kSide; ++l)
          if (left + l >= 0 && left + l < depth.width) row[l] = depth.row(v)[left + l];
      }
    }
    for (int l = 0; l < kLanes; ++l) {
      const float raw = static_cast<float>(row[l]);
      patch.raw[r][l] = (raw >= low) & (raw <= high) & isInside(l) ? raw : 0.0f;
    }
  }
  return patch;
}

// The valid measurement nearest to (dx, dy), given from the middle of the patch; 0: none near enough.
float findAnchor(const Patch &patch, float dx, float dy) {
  if (patch.raw[kRadius][kRadius] > 0) return patch.raw[kRadius][kRadius];
  float nearest2 = kFarthestAnchor2, anchor = 0;
  for (int r = 0; r < kSide; ++r) {
    for (int l = 0; l < kSide; ++l) {
      const float x = static_cast<float>(l - kRadius) - dx, y = static_cast<float>(r - kRadius) - dy;
      const float distance2 = x * x + y * y;
      if (patch.raw[r][l] > 0 && distance2 < nearest2) nearest2 = distance2, anchor = patch.raw[r][l];
    }
  }
  return anchor;
}

// Sums over the samples of the anchor's surface; q: inverse depth relative to the anchor's, less 1.
struct Sums {
  float n, u, v, uu, uv, vv, q, qu, qv, qq;
};

Sums addUp(const Patch &patch, float anchor, float dx, float dy) {
  alignas(32) float n[kLanes] = {}, v1[kLanes] = {}, v2[kLanes] = {};
  alignas(32) float q1[kLanes] = {}, qv[kLanes] = {}, q2[kLanes] = {};
  for (int r = 0; r < kSide; ++r) {
    const float v = static_cast<float>(r - kRadius), away_v = absOf(v - dy);
    for (int l = 0; l < kLanes; ++l) {
      const float away_u = absOf(static_cast<float>(l - kRadius) - dx);
      const float limit = kSameSurface * (1 + (away_u > away_v ? away_u : away_v));
      const float raw = patch.raw[r][l];
      const float q = anchor / (raw > 0 ? raw : 1.0f) - 1;
      const float weight = (raw > 0) & (absOf(q) <= limit) ? 1.0f : 0.0f;
      const float weighted = weight * q;
      n[l] += weight, v1[l] += weight * v, v2[l] += weight * v * v;
      q1[l] += weighted, qv[l] += weighted * v, q2[l] += weighted * q;
    }
  }
  Sums sums = {};
  for (int l = 0; l < kSide; ++l) {
    const float u = static_cast<float>(l - kRadius);
    sums.n += n[l], sums.v += v1[l], sums.vv += v2[l];
    sums.u += u * n[l], sums.uu += u * u * n[l], sums.uv += u * v1[l];
    sums.q += q1[l], sums.qu += u * q1[l], sums.qv += qv[l], sums.qq += q2[l];
  }
  return sums;
}

struct Plane {  // q = a + b u + c v
  float a, b, c;
};

// Least squares with the pull on b and c: the mean out first, then two equations.
Plane fit(const Sums &s) {
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

float meanSquare(const Sums &s, const Plane &p) {
  const float linear = p.a * s.q + p.b * s.qu + p.c * s.qv;
  const float square = p.a * p.a * s.n + p.b * p.b * s.uu + p.c * p.c * s.vv +
                       2 * (p.a * p.b * s.u + p.a * p.c * s.v + p.b * p.c * s.uv);
  const float sum = s.qq - 2 * linear + square;
  return sum > 0 ? sum / s.n : 0;
}

}  // namespace

PatchDepth patchDepth(ImageView<uint16_t> depth, const DepthSensor &sensor, double x, double y) {
  const int cx = static_cast<int>(floorOf(x + 0.5)), cy = static_cast<int>(floorOf(y + 0.5));
  const float dx = static_cast<float>(x - cx), dy = static_cast<float>(y - cy);
  const Patch patch = loadPatch(depth, sensor, cx - kRadius, cy - kRadius);
  const float anchor = findAnchor(patch, dx, dy);
  if (!(anchor > 0)) return {};
  const Sums sums = addUp(patch, anchor, dx, dy);
  if (sums.n < kFewest) return {};
  const Plane plane = fit(sums);
  const float here = plane.a + plane.b * dx + plane.c * dy;
  if (!(absOf(here) <= 2 * kSameSurface)) return {};

  const double anchor_m = static_cast<double>(anchor) * sensor.unit_m;
  const double z = anchor_m / (1 + static_cast<double>(here));
  const double scatter = static_cast<double>(sqrtOf(meanSquare(sums, plane))) * z * z / anchor_m;
  // Few pixels of one surface: an edge runs through, and the keypoint may belong to either side.
  const double edge = 1 + 2 * (1 - static_cast<double>(sums.n) / (kSide * kSide));
  const double model = sensor.sigmaAt(z);
  return {z, edge * (scatter > model ? scatter : model)};
}

}  // namespace sphc
