#include "runtime/stages/features/scale_space.h"

#include <initializer_list>

#include "runtime/base/elementary.h"

namespace sphc {
namespace {

constexpr double kBlurReach = 3.0;  // standard deviations at which kernels end
constexpr int32_t kSmallestOctave = 12;
// As many rows as the widest blur reads; and of the differences, what lies between the first and the last one's
// lag, with the rows that refinement may visit on both sides.
constexpr int32_t kRingRows = 16, kDogRows = 32;

int32_t clampRow(int32_t y, int32_t height) { return y < 0 ? 0 : (y < height ? y : height - 1); }

int32_t sideOfOctave(int32_t side, int32_t first_octave, int32_t octave) {
  int32_t n = first_octave < 0 ? 2 * side : side;
  for (int32_t o = 0; o < octave; ++o) n = (n + 1) / 2;
  return n;
}

Plane takePlane(Arena &arena, const char *name, int32_t width, int32_t rows, int32_t row_mask) {
  const int32_t stride = paddedWidth(width);
  return {arena.take<int16_t>(name, static_cast<size_t>(stride) * static_cast<size_t>(rows)).data(), stride,
          row_mask};
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

ScaleSpace::Kernel ScaleSpace::gaussian(double sigma) {
  Kernel kernel = {};
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
         sideOfOctave(shorter, config.first_octave, count) >= kSmallestOctave) {
    ++count;
  }
  return count;
}

void ScaleSpace::layout(const FeatureConfig &config, Arena &, Arena &scratch, ScaleSpace *out) {
  ScaleSpace measured;
  ScaleSpace &self = out ? *out : measured;
  self.first_octave_ = config.first_octave < 0 ? -1 : 0;
  self.setSize(config);
  for (int32_t o = 0; o < self.octaves_; ++o) {
    for (Plane &plane : self.kept_[o]) {
      plane = takePlane(scratch, "features.levels", self.widths_[o], self.heights_[o], -1);
    }
  }
  const int32_t width = self.widths_[0];
  const auto ring = [&](const char *name, int32_t rows) { return takePlane(scratch, name, width, rows, rows - 1); };
  for (const int32_t l : {int32_t{0}, kLevels - 2}) self.ring_[l] = ring("features.level_rings", kRingRows);
  self.ring_[kLevels - 1] = ring("features.level_rings", 1);  // for its difference alone
  self.source_ = ring("features.source_ring", kRingRows);
  for (Plane &plane : self.differences_) plane = ring("features.differences", kDogRows);
  // Kernels read whole vectors beyond a row's end, here beyond the last plane's.
  scratch.take<int16_t>("features.margin", 2 * kRowStep);
  self.padded_ = scratch.take<int16_t>("features.blur_row",
                                       kRowsAtOnce * static_cast<size_t>(paddedWidth(width) + 2 * kRowStep));
}

void ScaleSpace::setSize(const FeatureConfig &config) {
  octaves_ = octaveCount(config);
  for (int32_t o = 0; o < octaves_; ++o) {
    widths_[o] = sideOfOctave(config.width, config.first_octave, o);
    heights_[o] = sideOfOctave(config.height, config.first_octave, o);
  }
}

void ScaleSpace::init(const FeatureKernels &kernels) {
  row_kernels_ = &kernels;
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
  SPHC_ASSERT(base_lags_[kLevels - 1] - base_lags_[1] + 2 * kRefineReach + 2 + kRowsAtOnce <= kDogRows);
}

float ScaleSpace::pixelSize(int32_t octave) const {
  const float whole = static_cast<float>(1 << octave);
  return first_octave_ < 0 ? 0.5f * whole : whole;
}

void ScaleSpace::beginBand(int32_t octave, Rows rows, GrayView gray) {
  octave_ = octave;
  width_ = widths_[octave];
  rows_[octave] = rows;
  height_ = rows.count;
  gray_ = gray;
  for (int32_t l = 0; l < kLevels; ++l) level_[l] = l >= 1 && l <= kScales ? kept_[octave][l - 1] : ring_[l];
}

void ScaleSpace::step(int32_t y) {
  for (int32_t i = 0; i < kRowsAtOnce && y + i < height_; ++i) firstRow(y + i);
  if (octave_ == 0) blurInto(base_kernel_, source_, level_[0], nullptr, y - lag(0));
  for (int32_t l = 1; l < kLevels; ++l) {
    blurInto(kernels_[l], level_[l - 1], level_[l], &differences_[l - 1], y - lag(l));
  }
}

void ScaleSpace::skim(int32_t y) {
  for (int32_t i = 0; i < kRowsAtOnce && y + i < height_; ++i) firstRow(y + i);
  const Plane &from = octave_ == 0 ? source_ : level_[0];
  blurInto(skimKernel(), from, kept_[octave_][kScales - 1], nullptr, y - skimLag(), 1);
}

// Takes the row from the image, or every second pixel of the level with twice the base's blur.
void ScaleSpace::firstRow(int32_t y) {
  const int32_t from = rows_[octave_].first + y;
  if (octave_ > 0) {
    row_kernels_->halve_row(kept_[octave_ - 1][kScales - 1].row(2 * from), level_[0].row(y), width_);
  } else if (first_octave_ == 0) {
    row_kernels_->scale_row(gray_.row(from), source_.row(y), width_);
  } else {
    const uint8_t *lower = gray_.row(clampRow((from + 1) / 2, gray_.height));
    row_kernels_->double_row(gray_.row(from / 2), lower, source_.row(y), gray_.width);
  }
}

// So many rows from y on.
void ScaleSpace::blurInto(const Kernel &kernel, const Plane &from, const Plane &to, const Plane *difference,
                          int32_t y, int32_t rows) {
  const int32_t first = y < 0 ? 0 : y, end = y + rows < height_ ? y + rows : height_;
  if (end <= first) return;
  BlurTask task;
  task.radius = kernel.radius;
  task.width = width_;
  task.count = end - first;
  for (int32_t k = 0; k < 2 * kernel.radius + task.count; ++k) {
    task.rows[k] = from.row(clampRow(first + k - kernel.radius, height_));
  }
  for (int32_t k = 0; k <= kernel.radius; ++k) task.weights[k] = kernel.weights[k];
  task.padded = padded_.data();
  for (int32_t i = 0; i < task.count; ++i) {
    task.out[i] = to.row(first + i);
    task.difference[i] = difference ? difference->row(first + i) : nullptr;
  }
  row_kernels_->blur_rows(task);
}

}  // namespace sphc
