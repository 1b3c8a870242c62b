#include "runtime/stages/align/depth_reader.h"

#include <algorithm>
#include <cstring>

#include "runtime/base/elementary.h"

namespace sphc {
namespace {

// This file is compiled small, where divisions by constants are divisions: there are none for each pixel.
constexpr int32_t kCosineBits = 16;
constexpr int32_t kJumpShift = 5;  // a step to a neighbour of more than 1 / 32 is an edge, not a slope

bool isInPlace(const DepthReaderConfig &config) {
  return config.layout.kind == DepthLayout::kUnits && !config.layout.is_range && config.least_amplitude == 0;
}

// Is z beyond one neighbour and before the other, by an edge each?
bool isBetween(int32_t z, int32_t a, int32_t b) {
  if (a == 0 || b == 0) return false;
  const int32_t jump = z >> kJumpShift, from_a = z - a, to_b = b - z;
  return (from_a > jump && to_b > jump) || (from_a < -jump && to_b < -jump);
}

constexpr double kNothing = 1e9;  // units: as far as this is what simulators give where nothing was hit

// 0 for what is no measurement.  What is beyond 16 bits is the farthest: a wrong unit must not look like a sensor
// that sees nothing.
uint16_t unitsFrom(double units) {
  const double rounded = units + 0.5;
  return rounded >= 1 && rounded < kNothing ? static_cast<uint16_t>(std::min(rounded, 65535.0)) : uint16_t{0};
}

}  // namespace

void DepthReader::layout(const DepthReaderConfig &config, Arena &state, Arena &scratch, DepthReader *reader) {
  if (isInPlace(config)) return;
  const auto width = static_cast<size_t>(config.camera.width()),
             height = static_cast<size_t>(config.camera.height());
  DepthReader discarded;
  DepthReader &r = reader ? *reader : discarded;
  if (config.layout.is_range) r.cosines_ = state.take<uint16_t>("depth.cosines", width * height);
  r.z_ = scratch.take<uint16_t>("depth.z", width * height);
  if (config.least_amplitude) r.rows_ = scratch.take<uint16_t>("depth.rows", 2 * width);
}

void DepthReader::init(const DepthReaderConfig &config) {
  config_ = config;
  width_ = config.camera.width();
  height_ = config.camera.height();
  if (config.layout.is_range) makeCosines();
}

void DepthReader::makeCosines() {
  size_t at = 0;
  for (int32_t y = 0; y < height_; ++y) {
    for (int32_t x = 0; x < width_; ++x, ++at) {
      Vector2 ray;
      const bool has_ray = config_.camera.unproject({x + 0.5, y + 0.5}, &ray);
      const double cosine = has_ray ? 1 / sqrtOf(1 + ray.squaredNorm()) : 0;
      cosines_[at] = static_cast<uint16_t>(std::min(cosine * (1 << kCosineBits) + 0.5, 65535.0));
    }
  }
}

ImageView<uint16_t> DepthReader::read(const ByteView &depth, const AmplitudeView &amplitude) {
  if (isInPlace(config_))
    return {reinterpret_cast<const uint16_t *>(depth.data), width_, height_, depth.stride / 2};
  for (int32_t y = 0; y < height_; ++y) {
    uint16_t *z = z_.data() + int64_t{y} * width_;
    decodeRow(depth.row(y), y, z);
    if (config_.least_amplitude && amplitude.bytes.data) dropFaint(amplitude, y, z);
  }
  if (config_.least_amplitude) dropFlying();
  return {z_.data(), width_, height_, width_};
}

void DepthReader::decodeRow(const uint8_t *from, int32_t y, uint16_t *z) const {
  const DepthLayout layout = config_.layout;
  const uint16_t *cosines = layout.is_range ? cosines_.data() + int64_t{y} * width_ : nullptr;
  const double per_metre = 1 / config_.unit_m, of_range = per_metre / (1 << kCosineBits);
  for (int32_t x = 0; x < width_; ++x) {
    if (layout.kind == DepthLayout::kMetres) {
      float metres;
      std::memcpy(&metres, from + 4 * x, sizeof metres);
      z[x] = unitsFrom(static_cast<double>(metres) * (cosines ? of_range * cosines[x] : per_metre));
      continue;
    }
    uint32_t units = 0;
    if (layout.kind == DepthLayout::kUnits) {
      uint16_t read;
      std::memcpy(&read, from + 2 * x, sizeof read);
      units = read;
    } else {
      const uint8_t *pair = from + 3 * (x / 2);
      units = static_cast<uint32_t>(x % 2 ? pair[1] << 4 | pair[2] >> 4 : pair[0] << 4 | (pair[2] & 15));
    }
    z[x] = static_cast<uint16_t>(cosines ? (units * cosines[x] + (1u << (kCosineBits - 1))) >> kCosineBits : units);
  }
}

void DepthReader::dropFaint(const AmplitudeView &amplitude, int32_t y, uint16_t *z) const {
  const uint8_t *light = amplitude.bytes.row(y);
  for (int32_t x = 0; x < width_; ++x, light += amplitude.pixel_bytes) {
    const uint32_t seen = amplitude.pixel_bytes == 1 ? light[0] : static_cast<uint32_t>(light[0] | light[1] << 8);
    if (seen < config_.least_amplitude) z[x] = 0;
  }
}

// Neighbours count as they were before any was dropped.
void DepthReader::dropFlying() {
  uint16_t *above = rows_.data(), *here = above + width_;
  std::fill(above, here, uint16_t{0});
  for (int32_t y = 0; y < height_; ++y, std::swap(above, here)) {
    uint16_t *z = z_.data() + int64_t{y} * width_;
    std::copy(z, z + width_, here);
    const uint16_t *below = y + 1 < height_ ? z + width_ : nullptr;
    for (int32_t x = 0; x < width_; ++x) {
      const bool inside = x > 0 && x + 1 < width_;
      if ((inside && isBetween(here[x], here[x - 1], here[x + 1])) ||
          (below && isBetween(here[x], above[x], below[x])))
        z[x] = 0;
    }
  }
}

}  // namespace sphc
