// Images drawn from formulas, and an extractor in memory that notices being overrun.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <vector>

#include "runtime/base/random.h"
#include "runtime/stages/features/extractor.h"
#include "tests/support/guarded_memory.h"

namespace sphc {

struct TestImage {
  int32_t width, height, stride;
  std::vector<uint8_t> pixels;

  TestImage(int32_t w, int32_t h, int32_t s = 0)
      : width(w), height(h), stride(s ? s : w), pixels(static_cast<size_t>(stride) * static_cast<size_t>(h)) {}
  uint8_t &at(int32_t x, int32_t y) { return pixels[indexOf(x, y)]; }
  uint8_t at(int32_t x, int32_t y) const { return pixels[indexOf(x, y)]; }
  size_t indexOf(int32_t x, int32_t y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(stride) + static_cast<size_t>(x);
  }
  GrayView view() const { return {pixels.data(), width, height, stride}; }
};

// `shade` takes pixel coordinates: the top-left pixel's centre is (0.5, 0.5).
inline TestImage draw(int32_t width, int32_t height, const std::function<double(double, double)> &shade) {
  TestImage image(width, height);
  for (int32_t y = 0; y < height; ++y) {
    for (int32_t x = 0; x < width; ++x) {
      const double value = std::round(shade(x + 0.5, y + 0.5));
      image.at(x, y) = static_cast<uint8_t>(value < 0 ? 0 : (value > 255 ? 255 : value));
    }
  }
  return image;
}

inline TestImage noise(int32_t width, int32_t height, uint64_t seed, int32_t stride = 0) {
  TestImage image(width, height, stride);
  Random random(seed);
  for (uint8_t &pixel : image.pixels) pixel = static_cast<uint8_t>(random.below(256));
  return image;
}

// A world of soft spots of many sizes, bright and dark; `zoom` enlarges it about the origin.
inline TestImage spots(int32_t width, int32_t height, uint64_t seed, double zoom = 1) {
  std::vector<float> shade(static_cast<size_t>(width) * static_cast<size_t>(height), 128.0f);
  Random random(seed);
  const int32_t count = static_cast<int32_t>(width * height / (zoom * zoom) / 150);
  for (int32_t i = 0; i < count; ++i) {
    const double cx = random.uniform() * width, cy = random.uniform() * height;
    const double sx = zoom * (1.5 + 4 * random.uniform()), sy = sx * (0.6 + 0.8 * random.uniform());
    const double gray = 140 * random.uniform() - 70;
    for (int32_t y = static_cast<int32_t>(cy - 4 * sy); y < cy + 4 * sy; ++y) {
      for (int32_t x = static_cast<int32_t>(cx - 4 * sx); x < cx + 4 * sx; ++x) {
        if (x < 0 || y < 0 || x >= width || y >= height) continue;
        const double dx = (x + 0.5 - cx) / sx, dy = (y + 0.5 - cy) / sy;
        shade[static_cast<size_t>(y * width + x)] +=
            static_cast<float>(gray * std::exp(-0.5 * (dx * dx + dy * dy)));
      }
    }
  }
  return draw(width, height, [&](double x, double y) {
    return static_cast<double>(
        shade[static_cast<size_t>(static_cast<int32_t>(y) * width + static_cast<int32_t>(x))]);
  });
}

struct Features {
  std::vector<Keypoint> keypoints;
  std::vector<Descriptor> descriptors;
};

class TestExtractor {
 public:
  explicit TestExtractor(const FeatureConfig &config, uint8_t fill = 0xA5,
                         const FeatureKernels &kernels = simdFeatureKernels(), const Parallel &parallel = {})
      : config_(config),
        state_(stateBytes(config), kArenaAlignment, fill),
        scratch_(scratchBytes(config), kArenaAlignment, fill) {
    Arena state(state_.data()), scratch(scratch_.data());
    FeatureExtractor::layout(config, state, scratch, &extractor_);
    used_as_measured_ = state.used() == state_.size() && scratch.used() == scratch_.size();
    extractor_.init(kernels, parallel);
  }

  Features operator()(const TestImage &image, const Deadline &deadline = {}) {
    Features out;
    Keypoint marker = {};
    marker.x_px = -1;
    out.keypoints.assign(config_.max_keypoints + 1, marker);
    out.descriptors.resize(config_.max_keypoints + 1);
    const uint32_t count = extractor_.extract(image.view(), {out.keypoints.data(), config_.max_keypoints},
                                              {out.descriptors.data(), config_.max_keypoints}, deadline);
    outputs_intact_ = count <= config_.max_keypoints && out.keypoints.back().x_px == -1;
    out.keypoints.resize(count);
    out.descriptors.resize(count);
    return out;
  }

  bool sound() { return used_as_measured_ && outputs_intact_ && state_.guardsIntact() && scratch_.guardsIntact(); }
  bool wasCut() const { return extractor_.wasCut(); }
  size_t stateBytes() const { return state_.size(); }
  size_t scratchBytes() const { return scratch_.size(); }

 private:
  static size_t stateBytes(const FeatureConfig &config) {
    Arena state, scratch;
    FeatureExtractor::layout(config, state, scratch, nullptr);
    return state.used();
  }
  static size_t scratchBytes(const FeatureConfig &config) {
    Arena state, scratch;
    FeatureExtractor::layout(config, state, scratch, nullptr);
    return scratch.used();
  }

  FeatureConfig config_;
  test::GuardedMemory state_, scratch_;
  FeatureExtractor extractor_;
  bool used_as_measured_ = false, outputs_intact_ = true;
};

inline FeatureConfig configFor(const TestImage &image, uint32_t max_keypoints = 800) {
  FeatureConfig config;
  config.width = image.width;
  config.height = image.height;
  config.max_keypoints = max_keypoints;
  return config;
}

inline Features extractFrom(const TestImage &image, uint32_t max_keypoints = 800) {
  return TestExtractor(configFor(image, max_keypoints))(image);
}

inline bool same(const Features &a, const Features &b) {
  return a.keypoints.size() == b.keypoints.size() &&
         std::memcmp(a.keypoints.data(), b.keypoints.data(), a.keypoints.size() * sizeof(Keypoint)) == 0 &&
         std::memcmp(a.descriptors.data(), b.descriptors.data(), a.descriptors.size() * sizeof(Descriptor)) == 0;
}

// RootSIFT bytes have the length 512, so a distance of 512 is 60 degrees.
inline double distance(const Descriptor &a, const Descriptor &b) {
  double sum = 0;
  for (size_t i = 0; i < kDescriptorBytes; ++i) sum += (a.bytes[i] - b.bytes[i]) * (a.bytes[i] - b.bytes[i]);
  return std::sqrt(sum);
}

}  // namespace sphc
