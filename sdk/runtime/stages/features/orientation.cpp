#include "runtime/stages/features/orientation.h"

#include <initializer_list>

#include "runtime/stages/features/row_kernels.h"

namespace sphc {
namespace {

constexpr int32_t kBins = 36;
constexpr float kWindowSigma = 1.5f;  // of the keypoint's
constexpr float kWindowReach = 2.0f;  // standard deviations of the window
constexpr float kSecondPeak = 0.8f;   // of the highest
constexpr int32_t kMaxRadius = 8;     // three times the coarsest keypoint's 2.25 pixels, rounded up
constexpr int32_t kMaxSide = 2 * kMaxRadius + 1;

// By [1 4 6 4 1] / 16.
void smooth(const float in[kBins], float out[kBins]) {
  for (int32_t i = 0; i < kBins; ++i) {
    const float outer = in[(i + kBins - 2) % kBins] + in[(i + 2) % kBins];
    const float inner = in[(i + kBins - 1) % kBins] + in[(i + 1) % kBins];
    out[i] = (outer + 4.0f * inner + 6.0f * in[i]) * 0.0625f;
  }
}

// Peak of the parabola through a bin and its neighbours, as an angle.
float peakAngle(const float h[kBins], int32_t i) {
  const float left = h[(i + kBins - 1) % kBins], right = h[(i + 1) % kBins];
  const float shift = 0.5f * (left - right) / (left + right - 2.0f * h[i]);
  const float angle = (static_cast<float>(i) + shift) * static_cast<float>(2.0 * kPi / kBins);
  return angle > static_cast<float>(kPi) ? angle - static_cast<float>(2.0 * kPi) : angle;
}

int32_t highestPeak(const float h[kBins], int32_t besides) {
  int32_t best = -1;
  for (int32_t i = 0; i < kBins; ++i) {
    const float left = h[(i + kBins - 1) % kBins], right = h[(i + 1) % kBins];
    if (i == besides || !(h[i] > left) || !(h[i] >= right)) continue;
    if (best < 0 || h[i] > h[best]) best = i;
  }
  return best;
}

}  // namespace

void OrientationFinder::layout(Arena &scratch, OrientationFinder *out) {
  OrientationFinder measured;
  OrientationFinder &self = out ? *out : measured;
  constexpr size_t kSamples = static_cast<size_t>(kMaxSide) * kMaxSide;
  for (Span<float> *values : {&self.dx_, &self.dy_, &self.magnitude_, &self.angle_}) {
    *values = scratch.take<float>("features.orientation_window", kSamples);
  }
}

// Gradients of the pixels of the window and their weights; returns how many.
int32_t OrientationFinder::gather(const Plane &level, int32_t width, int32_t height, float x, float y, float sigma,
                                  const GaussianTable &gaussian) {
  const int32_t center_x = static_cast<int32_t>(x + 0.5f), center_y = static_cast<int32_t>(y + 0.5f);
  const int32_t wanted = static_cast<int32_t>(kWindowReach * kWindowSigma * sigma + 0.5f);
  const int32_t radius = wanted < kMaxRadius ? wanted : kMaxRadius;
  const int32_t left = center_x - radius > 1 ? center_x - radius : 1;
  const int32_t right = center_x + radius < width - 2 ? center_x + radius : width - 2;
  const int32_t top = center_y - radius > 1 ? center_y - radius : 1;
  const int32_t bottom = center_y + radius < height - 2 ? center_y + radius : height - 2;
  const float falloff = 0.5f / (kWindowSigma * kWindowSigma * sigma * sigma);
  const auto weight = [&](float distance) { return gaussian(distance * distance * falloff); };

  float across[kMaxSide];
  for (int32_t i = left; i <= right; ++i) across[i - left] = weight(static_cast<float>(i) - x);
  float *dx = dx_.data(), *dy = dy_.data(), *magnitude = magnitude_.data();
  const int32_t n = right - left + 1;
  int32_t count = 0;
  for (int32_t j = top; j <= bottom; ++j, count += n) {
    const float *row = level.row(j) + left, *above = level.row(j - 1) + left, *below = level.row(j + 1) + left;
    const float down = weight(static_cast<float>(j) - y);
    for (int32_t i = 0; i < n; ++i) {
      dx[count + i] = row[i + 1] - row[i - 1];
      dy[count + i] = below[i] - above[i];
      magnitude[count + i] = down * across[i];
    }
  }
  return count;
}

int32_t OrientationFinder::find(const Plane &level, int32_t width, int32_t height, float x, float y, float sigma,
                                const GaussianTable &gaussian, int32_t limit, float angles[2]) {
  const int32_t count = gather(level, width, height, x, y, sigma, gaussian);
  polarGradients(dx_.data(), dy_.data(), static_cast<float>(kBins), magnitude_.data(), angle_.data(), count);
  float raw[kBins + 1] = {}, histogram[kBins];
  for (int32_t i = 0; i < count; ++i) {
    raw[static_cast<int32_t>(angle_.data()[i] + 0.5f)] += magnitude_.data()[i];
  }
  raw[0] += raw[kBins];  // rounded up to a full turn
  smooth(raw, histogram);

  const int32_t first = highestPeak(histogram, -1);
  if (first < 0) return 0;
  angles[0] = peakAngle(histogram, first);
  const int32_t second = limit > 1 ? highestPeak(histogram, first) : -1;
  if (second < 0 || histogram[second] < kSecondPeak * histogram[first]) return 1;
  angles[1] = peakAngle(histogram, second);
  return 2;
}

}  // namespace sphc
