#include "runtime/stages/features/descriptor.h"

#include <initializer_list>

#include "runtime/base/elementary.h"
#include "runtime/stages/features/row_kernels.h"

namespace sphc {
namespace {

constexpr int32_t kCells = 4, kBins = 8;
constexpr float kCellSigmas = 3.5f;        // side of a cell in standard deviations of the keypoint
constexpr int32_t kPerCell = 3;            // samples along the side of a cell
constexpr int32_t kSide = 5 * kPerCell;    // gradient samples: the four cells and half a cell around them
constexpr int32_t kPatchSide = kSide + 2;  // with their neighbours
constexpr float kWindowCells = 2.0f;       // standard deviation of the window: half the descriptor's width
constexpr float kClamp = 0.2f;             // against single strong gradients (Lowe 2004, section 6.1)

constexpr int32_t kRowBins = (kCells + 2) * kBins;  // a cell of margin on each side, for samples outside

// Cell coordinate of sample i along a side: cells 0 .. 3 are centred at 0 .. 3.
constexpr double cellOf(int32_t i) { return (i + 0.5) / kPerCell - 1.0; }
// The margin makes the index of the cell before the sample >= 0.
constexpr int32_t cellBefore(int32_t i) { return (2 * i + 1) / (2 * kPerCell); }

// Sum in eight fixed lanes: the same order on every machine, and short chains.
float sumOf(const float values[kDescriptorBytes], bool squared) {
  float lanes[8] = {};
  for (size_t i = 0; i < kDescriptorBytes; i += 8) {
    for (size_t k = 0; k < 8; ++k) lanes[k] += squared ? values[i + k] * values[i + k] : values[i + k];
  }
  return ((lanes[0] + lanes[4]) + (lanes[2] + lanes[6])) + ((lanes[1] + lanes[5]) + (lanes[3] + lanes[7]));
}

void toRootSift(float histogram[kDescriptorBytes], Descriptor *out) {
  const float limit = kClamp * sqrtOf(sumOf(histogram, true));
  for (size_t i = 0; i < kDescriptorBytes; ++i) histogram[i] = histogram[i] < limit ? histogram[i] : limit;
  const float sum = sumOf(histogram, false);
  const float scale = sum > 0.0f ? 512.0f * 512.0f / sum : 0.0f;
  for (size_t i = 0; i < kDescriptorBytes; ++i) {
    const float root = sqrtOf(histogram[i] * scale) + 0.5f;
    out->bytes[i] = static_cast<uint8_t>(static_cast<int32_t>(root < 255.0f ? root : 255.0f));
  }
}

float clampTo(float value, float limit) { return value < 0.0f ? 0.0f : (value < limit ? value : limit); }

float bilinear(const float *pixel, int32_t stride, float fx, float fy) {
  const float *below = pixel + stride;
  const float upper = pixel[0] + fx * (pixel[1] - pixel[0]), lower = below[0] + fx * (below[1] - below[0]);
  return upper + fy * (lower - upper);
}

}  // namespace

void Describer::layout(Arena &state, Arena &scratch, Describer *out) {
  Describer measured;
  Describer &self = out ? *out : measured;
  constexpr size_t kSamples = static_cast<size_t>(kSide) * kSide;
  self.window_ = state.take<float>("features.descriptor_window", kSamples);
  self.shares_ = state.take<float>("features.descriptor_shares", 2 * kSide);
  self.patch_ = scratch.take<float>("features.descriptor_patch", static_cast<size_t>(kPatchSide) * kPatchSide);
  for (Span<float> *values : {&self.dx_, &self.dy_, &self.magnitude_, &self.angle_}) {
    *values = scratch.take<float>("features.descriptor_gradients", kSamples);
  }
}

void Describer::init() {
  const auto weight = [](int32_t i) {
    const double distance = cellOf(i) - (kCells - 1) / 2.0;
    return expOf(-0.5 * distance * distance /
                 (static_cast<double>(kWindowCells) * static_cast<double>(kWindowCells)));
  };
  for (int32_t j = 0; j < kSide; ++j) {
    for (int32_t i = 0; i < kSide; ++i) {
      window_[static_cast<size_t>(j * kSide + i)] = static_cast<float>(weight(i) * weight(j));
    }
    const double after = cellOf(j) + 1 - cellBefore(j);
    shares_[static_cast<size_t>(2 * j)] = static_cast<float>(1 - after);
    shares_[static_cast<size_t>(2 * j + 1)] = static_cast<float>(after);
  }
}

void Describer::describe(const Plane &level, int32_t width, int32_t height, float x, float y, float sigma,
                         float orientation, Descriptor *out) {
  samplePatch(level, width, height, x, y, sigma, orientation);
  differentiate();
  float histogram[kDescriptorBytes];
  pool(histogram);
  toRootSift(histogram, out);
}

void Describer::samplePatch(const Plane &level, int32_t width, int32_t height, float x, float y, float sigma,
                            float orientation) {
  double sine, cosine;
  sinCos(static_cast<double>(orientation), &sine, &cosine);
  const float step = sigma * (kCellSigmas / kPerCell);
  const float c = static_cast<float>(cosine) * step, s = static_cast<float>(sine) * step;
  constexpr float kMiddle = 0.5f * (kPatchSide - 1);
  const float reach = kMiddle * (absOf(c) + absOf(s)) + 0.01f;  // rounding
  const float last_x = static_cast<float>(width) - 1.001f, last_y = static_cast<float>(height) - 1.001f;
  const bool inside = x >= reach && y >= reach && x + reach <= last_x && y + reach <= last_y;
  float *out = patch_.data();
  for (int32_t j = 0; j < kPatchSide; ++j) {
    const float v = static_cast<float>(j) - kMiddle;
    const float row_x = x - s * v, row_y = y + c * v;
    for (int32_t i = 0; i < kPatchSide; ++i) {
      const float u = static_cast<float>(i) - kMiddle;
      float px = row_x + c * u, py = row_y + s * u;
      if (!inside) px = clampTo(px, last_x), py = clampTo(py, last_y);
      const int32_t ix = static_cast<int32_t>(px), iy = static_cast<int32_t>(py);
      const float *pixel = level.data + static_cast<int64_t>(iy) * level.stride + ix;
      *out++ = bilinear(pixel, level.stride, px - static_cast<float>(ix), py - static_cast<float>(iy));
    }
  }
}

// The patch lies in the keypoint's axes, so its gradients need no turning.
void Describer::differentiate() {
  float *dx = dx_.data(), *dy = dy_.data(), *magnitude = magnitude_.data();
  for (int32_t j = 0; j < kSide; ++j) {
    const float *row = patch_.data() + (j + 1) * kPatchSide + 1;
    for (int32_t i = 0; i < kSide; ++i) {
      dx[j * kSide + i] = row[i + 1] - row[i - 1];
      dy[j * kSide + i] = row[i + kPatchSide] - row[i - kPatchSide];
      magnitude[j * kSide + i] = window_.data()[j * kSide + i];
    }
  }
  polarGradients(dx, dy, static_cast<float>(kBins), magnitude, angle_.data(), kSide * kSide);
}

// Every sample is shared among the two nearest cells across, down, and the two nearest bins.
void Describer::pool(float histogram[kDescriptorBytes]) const {
  float cells[kCells + 2][kRowBins] = {};
  const float *magnitude = magnitude_.data(), *angle = angle_.data(), *shares = shares_.data();
  for (int32_t j = 0; j < kSide; ++j) {
    float across[kRowBins] = {};
    for (int32_t i = 0; i < kSide; ++i, ++magnitude, ++angle) {
      const int32_t bin = static_cast<int32_t>(*angle);
      const float after = *magnitude * (*angle - static_cast<float>(bin)), before = *magnitude - after;
      const int32_t low = bin & (kBins - 1), high = (bin + 1) & (kBins - 1);
      float *cell = across + cellBefore(i) * kBins;
      cell[low] += before * shares[2 * i];
      cell[high] += after * shares[2 * i];
      cell[kBins + low] += before * shares[2 * i + 1];
      cell[kBins + high] += after * shares[2 * i + 1];
    }
    float *upper = cells[cellBefore(j)], *lower = cells[cellBefore(j) + 1];
    for (int32_t k = 0; k < kRowBins; ++k) {
      upper[k] += across[k] * shares[2 * j];
      lower[k] += across[k] * shares[2 * j + 1];
    }
  }
  for (int32_t r = 0; r < kCells; ++r) {
    for (int32_t k = 0; k < kCells * kBins; ++k) histogram[r * kCells * kBins + k] = cells[r + 1][kBins + k];
  }
}

}  // namespace sphc
