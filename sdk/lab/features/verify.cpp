#include "lab/features/verify.h"

#include <cmath>
#include <cstring>

namespace sphc::host {
namespace {

int32_t squaredDistance(const uint8_t *a, const uint8_t *b, uint32_t bytes) {
  int32_t sum = 0;
  for (uint32_t i = 0; i < bytes; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

int32_t differingBits(const uint8_t *a, const uint8_t *b, uint32_t bytes) {
  int32_t sum = 0;
  for (uint32_t i = 0; i < bytes; ++i) sum += __builtin_popcount(static_cast<unsigned>(a[i] ^ b[i]));
  return sum;
}

}  // namespace

std::vector<FeatureMatch> matchByRatio(const FeaturesVariant &variant, const FoundFeatures &a,
                                       const FoundFeatures &b, double ratio) {
  const uint32_t bytes = variant.descriptor_bytes;
  const auto distance = variant.binary ? differingBits : squaredDistance;
  // of squares, but for bits
  const double limit = variant.binary ? ratio : ratio * ratio;
  std::vector<FeatureMatch> matches;
  for (uint32_t i = 0; i < a.pixels_px.size(); ++i) {
    int32_t nearest = INT32_MAX, second = INT32_MAX;
    uint32_t best = 0;
    for (uint32_t j = 0; j < b.pixels_px.size(); ++j) {
      const int32_t d = distance(&a.descriptors[size_t{i} * bytes], &b.descriptors[size_t{j} * bytes], bytes);
      if (d < nearest) {
        second = nearest, nearest = d, best = j;
      } else if (d < second) {
        second = d;
      }
    }
    if (nearest < limit * second) matches.push_back({i, best});
  }
  return matches;
}

std::vector<double> sampsonErrors(const Camera &camera, const Rigid &b_from_a, const FoundFeatures &a,
                                  const FoundFeatures &b, const std::vector<FeatureMatch> &matches) {
  const Vector3 &t = b_from_a.translation_m;
  Matrix3 cross;
  cross << 0, -t.z(), t.y(), t.z(), 0, -t.x(), -t.y(), t.x(), 0;
  const Matrix3 essential = cross * b_from_a.rotation;
  std::vector<double> errors;
  for (const FeatureMatch &match : matches) {
    Vector2 ray_a, ray_b;
    if (!camera.unproject(a.pixels_px[match.first], &ray_a) || !camera.unproject(b.pixels_px[match.second], &ray_b))
      continue;
    const Vector3 in_a(ray_a.x(), ray_a.y(), 1), in_b(ray_b.x(), ray_b.y(), 1);
    const Vector3 line_b = essential * in_a, line_a = essential.transpose() * in_b;
    const double slope2 = line_a.head<2>().squaredNorm() + line_b.head<2>().squaredNorm();
    errors.push_back(camera.focal() * std::abs(in_b.dot(line_b)) / std::sqrt(slope2));
  }
  return errors;
}

}  // namespace sphc::host
