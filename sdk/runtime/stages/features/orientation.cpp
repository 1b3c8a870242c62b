#include "runtime/stages/features/orientation.h"

namespace sphc {
namespace {

constexpr int32_t kBins = kOrientationBins;
constexpr float kWindowSigma = 1.5f;  // of the keypoint's
constexpr float kWindowReach = 2.0f;  // standard deviations of the window
constexpr float kSecondPeak = 0.8f;   // of the highest
constexpr int32_t kMaxRadius = kWindowSide / 2;

// A histogram with its ends repeated at the other side, so that no index has to turn round.
struct Circle {
  static constexpr int32_t kMargin = 2;
  float values[kBins + 2 * kMargin];

  float &operator[](int32_t i) { return values[i + kMargin]; }
  float operator[](int32_t i) const { return values[i + kMargin]; }
  void close() {
    for (int32_t i = 0; i < kMargin; ++i) {
      values[i] = values[i + kBins];
      values[kMargin + kBins + i] = values[kMargin + i];
    }
  }
};

// By [1 4 6 4 1] / 16.
void smooth(const Circle &in, Circle *out) {
  for (int32_t i = 0; i < kBins; ++i) {
    (*out)[i] = ((in[i - 2] + in[i + 2]) + 4.0f * (in[i - 1] + in[i + 1]) + 6.0f * in[i]) * 0.0625f;
  }
  out->close();
}

// Peak of the parabola through a bin and its neighbours, as an angle.
float peakAngle(const Circle &h, int32_t i) {
  const float shift = 0.5f * (h[i - 1] - h[i + 1]) / (h[i - 1] + h[i + 1] - 2.0f * h[i]);
  const float angle = (static_cast<float>(i) + shift) * static_cast<float>(2.0 * kPi / kBins);
  return angle > static_cast<float>(kPi) ? angle - static_cast<float>(2.0 * kPi) : angle;
}

// The first of the highest that are peaks, or -1.
int32_t highestPeak(const Circle &h, int32_t besides) {
  int32_t best = -1;
  float highest = 0.0f;
  for (int32_t i = 0; i < kBins; ++i) {
    if (h[i] > highest && h[i] > h[i - 1] && h[i] >= h[i + 1] && i != besides) best = i, highest = h[i];
  }
  return best;
}

OrientationWindow windowAt(const Plane &level, int32_t width, int32_t height, float x, float y, float sigma,
                           const GaussianTable &gaussian) {
  const int32_t center_x = static_cast<int32_t>(x + 0.5f), center_y = static_cast<int32_t>(y + 0.5f);
  const int32_t wanted = static_cast<int32_t>(kWindowReach * kWindowSigma * sigma + 0.5f);
  const int32_t radius = wanted < kMaxRadius ? wanted : kMaxRadius;
  const int32_t left = center_x - radius > 1 ? center_x - radius : 1;
  const int32_t right = center_x + radius < width - 2 ? center_x + radius : width - 2;
  const int32_t top = center_y - radius > 1 ? center_y - radius : 1;
  const int32_t bottom = center_y + radius < height - 2 ? center_y + radius : height - 2;
  const float falloff = 0.5f / (kWindowSigma * kWindowSigma * sigma * sigma);
  const auto weight = [&](int32_t i, float from) {
    const float distance = static_cast<float>(i) - from;
    return gaussian(distance * distance * falloff);
  };
  OrientationWindow window = {};
  window.pixels = level.row(top) + left;
  window.stride = level.stride;
  window.columns = right - left + 1;
  window.rows = bottom - top + 1;
  for (int32_t i = 0; i < window.columns; ++i) window.across[i] = weight(left + i, x);
  for (int32_t j = 0; j < window.rows; ++j) window.down[j] = weight(top + j, y);
  return window;
}

}  // namespace

int32_t findOrientations(const FeatureKernels &kernels, const Plane &level, int32_t width, int32_t height, float x,
                         float y, float sigma, const GaussianTable &gaussian, int32_t limit, float angles[2]) {
  Circle raw, histogram;
  kernels.orientation_histogram(windowAt(level, width, height, x, y, sigma, gaussian), &raw[0]);
  raw.close();
  smooth(raw, &histogram);

  const int32_t first = highestPeak(histogram, -1);
  if (first < 0) return 0;
  angles[0] = peakAngle(histogram, first);
  const int32_t second = limit > 1 ? highestPeak(histogram, first) : -1;
  if (second < 0 || histogram[second] < kSecondPeak * histogram[first]) return 1;
  angles[1] = peakAngle(histogram, second);
  return 2;
}

}  // namespace sphc
