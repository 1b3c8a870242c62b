#include "runtime/stages/features/descriptor.h"

#include "runtime/base/elementary.h"

namespace sphc {
namespace {

constexpr float kCellSigmas = 3.5f;   // side of a cell in standard deviations of the keypoint
constexpr float kPerCell = 3.0f;      // samples along the side of a cell
constexpr double kWindowCells = 2.0;  // standard deviation of the window: half the descriptor's width
constexpr float kMiddle = 0.5f * (kPatchSide - 1);

int32_t fixedOf(float pixels) { return static_cast<int32_t>(floorOf(static_cast<double>(pixels) * 65536.0 + 0.5)); }

}  // namespace

void Describer::layout(Arena &state, Describer *out) {
  const Span<PatchWindow> window = state.take<PatchWindow>("features.descriptor_window", 1);
  if (out) out->window_ = window;
}

void Describer::init() {
  const auto weight = [](int32_t i) {
    const double cells = (i - (kGradientSide - 1) / 2.0) / static_cast<double>(kPerCell);
    return expOf(-0.5 * cells * cells / (kWindowCells * kWindowCells));
  };
  PatchWindow *window = window_.data();
  for (int32_t j = 0; j < kGradientSide; ++j) {
    for (int32_t i = 0; i < kPatchSide; ++i) {
      const double of_one = i < kGradientSide ? weight(i) * weight(j) : 0.0;
      window->weights[j][i] = static_cast<int16_t>(floorOf((kOneQ15 - 1) * of_one + 0.5));
    }
  }
}

void Describer::describe(const FeatureKernels &kernels, const Plane &level, int32_t width, int32_t height, float x,
                         float y, float sigma, float orientation, Descriptor *out) const {
  double sine, cosine;
  sinCos(static_cast<double>(orientation), &sine, &cosine);
  const float step = sigma * (kCellSigmas / kPerCell);
  const float c = static_cast<float>(cosine) * step, s = static_cast<float>(sine) * step;
  PatchTask task;
  task.pixels = level.data;
  task.stride = level.stride;
  task.width = width;
  task.height = height;
  task.x = fixedOf(x - kMiddle * (c - s));
  task.y = fixedOf(y - kMiddle * (s + c));
  task.c = fixedOf(c);
  task.s = fixedOf(s);
  kernels.describe(task, *window_.data(), out);
}

}  // namespace sphc
