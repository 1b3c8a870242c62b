// exp(-t) for 0 <= t <= kReach by linear interpolation, to 4e-5: window weights need no more.
#pragma once
#include <cstdint>

#include "runtime/base/arena.h"
#include "runtime/base/elementary.h"

namespace sphc {

class GaussianTable {
 public:
  static constexpr float kReach = 8.0f;
  static constexpr int32_t kSteps = 512;

  static void layout(Arena &state, GaussianTable *out) {
    const Span<float> values = state.take<float>("features.gaussian", kSteps + 2);
    if (out) out->values_ = values;
  }
  void init() {
    for (int32_t i = 0; i < kSteps + 2; ++i) {
      values_[static_cast<size_t>(i)] = static_cast<float>(expOf(-static_cast<double>(kReach) * i / kSteps));
    }
  }
  float operator()(float t) const {
    if (!(t < kReach)) return 0.0f;
    const float position = t * (kSteps / kReach);
    const size_t i = static_cast<size_t>(position);
    return values_[i] + (position - static_cast<float>(i)) * (values_[i + 1] - values_[i]);
  }

 private:
  Span<float> values_;
};

}  // namespace sphc
