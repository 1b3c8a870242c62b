#include "runtime/stages/features/scale_space.h"

#include "runtime/base/elementary.h"

namespace sphc {
namespace {

constexpr double kBlurReach = 3.0;  // standard deviations at which kernels end
constexpr int32_t kSmallestOctave = 12;

int32_t sideOfOctave(int32_t first_side, int32_t octave) {
  int32_t n = first_side;
  for (int32_t o = 0; o < octave; ++o) n = (n + 1) / 2;
  return n;
}

double sigmaAt(double layer) { return kBaseSigma * expOf(layer * (0.69314718055994530942 / kScales)); }

}  // namespace

// 2^(layer / 3): the whole octaves and scales from a table, the rest by the series of e^u to 1e-7.
float sigmaOfLayer(float layer) {
  constexpr float kWhole[kLevels + 1] = {1.0f, 1.25992105f, 1.58740105f, 2.0f, 2.51984210f, 3.17480210f, 4.0f};
  static_assert(kScales == 3 && kBaseSigma == 1.0);
  const int32_t nearest = static_cast<int32_t>(layer + 0.5f);
  const float u = (layer - static_cast<float>(nearest)) * 0.23104906f;  // ln 2 / 3
  const float series = 1.0f + u * (1.0f + u * (0.5f + u * (0.16666667f + u * (0.041666667f + u * 0.0083333333f))));
  return kWhole[nearest] * series;
}

BlurKernel ScaleSpace::gaussian(double sigma) {
  BlurKernel kernel = {};
  const int32_t radius = static_cast<int32_t>(floorOf(kBlurReach * sigma + 0.5));
  kernel.radius = radius < 1 ? 1 : (radius > kMaxBlurRadius ? kMaxBlurRadius : radius);
  double values[kMaxBlurRadius + 1], sum = 0;
  for (int32_t k = 0; k <= kernel.radius; ++k) {
    values[k] = expOf(-0.5 * k * k / (sigma * sigma));
    sum += (k ? 2 : 1) * values[k];
  }
  int32_t middle = kOneQ15;
  for (int32_t k = 1; k <= kernel.radius; ++k) {
    kernel.weights[k] = static_cast<int16_t>(floorOf(kOneQ15 * values[k] / sum + 0.5));
    middle -= 2 * kernel.weights[k];
  }
  kernel.weights[0] = static_cast<int16_t>(middle);
  return kernel;
}

int32_t ScaleSpace::octaveCount(const FeatureConfig &config) {
  const int32_t shorter = config.width < config.height ? config.width : config.height;
  int32_t count = 1;
  while (count < kMaxOctaves && count < config.max_octaves &&
         sideOfOctave(firstOctaveSide(config, shorter), count) >= kSmallestOctave) {
    ++count;
  }
  return count;
}

void ScaleSpace::layout(const FeatureConfig &config, Arena &scratch, ScaleSpace *out) {
  ScaleSpace measured;
  ScaleSpace &self = out ? *out : measured;
  self.first_octave_ = config.first_octave < 0 ? -1 : 0;
  self.setSize(config);
  for (int32_t o = 0; o < self.octaves_; ++o)
    for (Plane &plane : self.kept_[o])
      plane = takePlane(scratch, "features.levels", self.widths_[o], self.heights_[o], -1);
}

void ScaleSpace::setSize(const FeatureConfig &config) {
  octaves_ = octaveCount(config);
  for (int32_t o = 0; o < octaves_; ++o) {
    widths_[o] = sideOfOctave(firstOctaveSide(config, config.width), o);
    heights_[o] = sideOfOctave(firstOctaveSide(config, config.height), o);
  }
}

void ScaleSpace::init() {
  // No blur is assumed in the input (Lowe 2004 assumes 0.5 pixels): sharper or not, the full blur found more
  // matches.
  base_kernel_ = gaussian(kBaseSigma);
  base_lags_[0] = 0;
  for (int32_t l = 1; l < kLevels; ++l) {
    const double below = sigmaAt(l - 1), here = sigmaAt(l);
    kernels_[l] = gaussian(sqrtOf(here * here - below * below));
    base_lags_[l] = base_lags_[l - 1] + kernels_[l].radius;
  }
  const double skimmed = sigmaAt(kScales);
  skim_kernels_[0] = gaussian(skimmed);
  skim_kernels_[1] = gaussian(sqrtOf(skimmed * skimmed - kBaseSigma * kBaseSigma));
}

float ScaleSpace::pixelSize(int32_t octave) const {
  const float whole = static_cast<float>(1 << octave);
  return isDoubled() ? 0.5f * whole : whole;
}

void ScaleSpace::beginBand(int32_t octave, Rows rows, GrayView gray) {
  octave_ = octave;
  rows_[octave] = rows;
  gray_ = gray;
}

}  // namespace sphc
