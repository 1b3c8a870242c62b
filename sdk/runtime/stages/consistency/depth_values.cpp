#include "runtime/stages/consistency/depth_values.h"

#include <algorithm>

namespace sphc {
namespace {

// Pixels around a sample, within 1 / 20 of it, are averaged: so many on each side, within a quarter of the way to
// the next sample, lest corners look round.
constexpr int32_t kMostSmoothPx = 2, kWindowShare = 4, kSurfaceShare = 20;
constexpr int32_t kReach = 4;          // samples from the middle of a place to its ends
constexpr float kSlanted2 = 0.006f;    // squared relative change of the inverse depth over the reach
constexpr float kSmooth = 0.05f;       // relative deviation of the samples between from a straight line
constexpr uint32_t kRangeShare = 256;  // two ranges within 1 / 256 may have been measured alike

// The least of three of one sign, else 0.
float leastOf(float a, float b, float c) {
  const float least = std::min(a, std::min(b, c)), most = std::max(a, std::max(b, c));
  return least > 0 ? least : std::min(most, 0.0f);
}

// The pixel of a sample, of a row or a column of `size` pixels with `count` samples.
int32_t pixelOf(int32_t sample, int32_t count, int32_t size) { return (2 * sample + 1) * size / (2 * count); }

}  // namespace

void DepthSamples::layout(Arena &state, DepthSamples *samples) {
  DepthSamples discarded;
  DepthSamples &s = samples ? *samples : discarded;
  s.rays_ = state.take<Ray>("consistency.rays", kCount);
  s.values_ = state.take<uint16_t>("consistency.samples", kCount);
  s.inverse_ = state.take<float>("consistency.samples", kCount);
  s.bends_ = state.take<float>("consistency.samples", kCount);
}

void DepthSamples::init(const Camera &camera, const DepthSensor &sensor, bool is_range) {
  sensor_ = sensor;
  is_range_ = is_range;
  for (int32_t row = 0; row < kRows; ++row) {
    for (int32_t column = 0; column < kColumns; ++column) {
      Vector2 ray = Vector2::Zero();
      // The pixel's own centre: in an image of few pixels that of the sample lies elsewhere, and planes would look
      // bent.
      const Vector2 px = {pixelOf(column, kColumns, camera.width()) + 0.5,
                          pixelOf(row, kRows, camera.height()) + 0.5};
      if (!camera.unproject(px, &ray)) ray = Vector2::Zero();
      rays_[static_cast<size_t>(row * kColumns + column)] = {static_cast<float>(ray.x()),
                                                             static_cast<float>(ray.y())};
    }
  }
}

DepthValues DepthSamples::look(ImageView<uint16_t> depth) {
  DepthValues found;
  uint32_t seen[DepthValues::kMostDistinct] = {};
  const int32_t half_pixels_apart = std::min(2 * depth.width / kColumns, 2 * depth.height / kRows);  // of samples
  const int32_t reach = std::min(kMostSmoothPx, half_pixels_apart / (2 * kWindowShare));
  for (int32_t row = 0; row < kRows; ++row) {
    const int32_t y = pixelOf(row, kRows, depth.height);
    for (int32_t column = 0; column < kColumns; ++column) {
      const size_t at = static_cast<size_t>(row * kColumns + column);
      const int32_t x = pixelOf(column, kColumns, depth.width);
      const uint16_t value = values_[at] = depth.row(y)[x];
      const double z = value * sensor_.unit_m;
      const bool in_range = value != 0 && z >= sensor_.min_m && z <= sensor_.max_m;
      inverse_[at] = in_range ? smoothInverse(depth, x, y, reach) : 0;
      ++found.samples;
      found.measured += value != 0;
      found.in_range += in_range;
      if (!in_range || found.distinct == DepthValues::kMostDistinct) continue;
      const uint32_t measured = asMeasured(value, at);
      const auto is_same = [&](uint32_t other) {
        const uint32_t apart = std::max(measured, other) - std::min(measured, other);
        return apart <= (is_range_ ? other / kRangeShare : 0);
      };
      if (std::none_of(seen, seen + found.distinct, is_same)) seen[found.distinct++] = measured;
    }
  }
  // Of fewer pixels hardly two samples are as far apart as the next two, and corners look round.
  if (half_pixels_apart < 3) return found;
  for (int32_t row = kReach; row < kRows - kReach; ++row)
    for (int32_t column = kReach; column < kColumns - kReach; ++column) addBend(column, row, &found);
  if (!found.slanted) return found;
  const auto begin = bends_.begin(), middle = begin + found.slanted / 2;
  std::nth_element(begin, middle, begin + found.slanted);
  found.bend = static_cast<double>(*middle);
  return found;
}

// A range: off by what z was rounded.
uint32_t DepthSamples::asMeasured(uint16_t z, size_t at) const {
  if (!is_range_) return z;
  const Ray ray = rays_[at];
  return static_cast<uint32_t>(static_cast<float>(z) * sqrtOf(1 + ray.x * ray.x + ray.y * ray.y) + 0.5f);
}

// One over the mean depth of the pixels around that are on the surface of the middle one.
float DepthSamples::smoothInverse(ImageView<uint16_t> depth, int32_t x, int32_t y, int32_t reach) const {
  const int32_t middle = depth.row(y)[x], most = middle / kSurfaceShare;
  int32_t sum = 0, count = 0;
  for (int32_t v = std::max(int32_t{0}, y - reach); v <= std::min(depth.height - 1, y + reach); ++v)
    for (int32_t u = std::max(int32_t{0}, x - reach); u <= std::min(depth.width - 1, x + reach); ++u) {
      const int32_t value = depth.row(v)[u];
      if (absOf(value - middle) > most) continue;
      sum += value;
      ++count;
    }
  return static_cast<float>(count / (sum * sensor_.unit_m));
}

// Are the samples between the middle of a place and its ends where a smooth surface has them?
bool DepthSamples::isSmooth(size_t at, size_t step) const {
  const float w = inverse_[at], before = inverse_[at - kReach * step], after = inverse_[at + kReach * step];
  const float half_before = inverse_[at - kReach / 2 * step], half_after = inverse_[at + kReach / 2 * step];
  if (!(w > 0 && before > 0 && after > 0 && half_before > 0 && half_after > 0)) return false;
  return absOf(half_before - 0.5f * (before + w)) < kSmooth * w &&
         absOf(half_after - 0.5f * (after + w)) < kSmooth * w;
}

void DepthSamples::addBend(int32_t column, int32_t row, DepthValues *found) {
  const size_t at = static_cast<size_t>(row * kColumns + column), across = 1, down = kColumns;
  if (!isSmooth(at, across) || !isSmooth(at, down)) return;
  const size_t l = at - kReach * across, r = at + kReach * across, u = at - kReach * down, d = at + kReach * down;
  const float w = inverse_[at];
  // The plane's slope by rays; a lens bends lines of pixels, so each direction is cleared of the other's part.
  const float wide = rays_[r].x - rays_[l].x, high = rays_[d].y - rays_[u].y;
  if (!(wide > 0 && high > 0)) return;
  const float b0 = (inverse_[d] - inverse_[u]) / high;
  const float a = (inverse_[r] - inverse_[l] - b0 * (rays_[r].y - rays_[l].y)) / wide;
  const float b = (inverse_[d] - inverse_[u] - a * (rays_[d].x - rays_[u].x)) / high;
  const float slope_x = 0.5f * a * wide / w, slope_y = 0.5f * b * high / w;
  const float slope2 = slope_x * slope_x + slope_y * slope_y;
  if (slope2 < kSlanted2) return;
  const auto off = [&](size_t i) {
    return inverse_[i] - w - a * (rays_[i].x - rays_[at].x) - b * (rays_[i].y - rays_[at].y);
  };
  // A corner bends two of the three second differences of a line at most; a surface that is bent, all.
  const auto bendAlong = [&](size_t step) {
    const size_t half = kReach / 2 * step;
    const float before = off(at - half), after = off(at + half);
    return 4 * leastOf(off(at - 2 * half) - 2 * before, before + after, off(at + 2 * half) - 2 * after);
  };
  bends_[found->slanted++] = (bendAlong(across) + bendAlong(down)) / (w * slope2);
}

}  // namespace sphc
