// Scores pose hypotheses: truncated sum of squared residuals (MSAC) over all correspondences, in single precision
// and in lanes that the compiler turns into SIMD.
#pragma once
#include "runtime/base/arena.h"
#include "runtime/geometry/rigid.h"
#include "runtime/types/correspondence.h"

namespace sphc {

class PoseScorer {
 public:
  static void layout(uint32_t capacity, Arena &scratch, PoseScorer *scorer);

  // Takes the correspondences in; at most `capacity`.
  void load(Span<const Correspondence> correspondences);
  // Sum of min(residual^2, truncation); gives up, with a value >= bound, once the sum has reached `bound`.
  float score(const Rigid &camera_from_map, float truncation, float bound) const;

 private:
  static constexpr uint32_t kLanes = 8;   // order of summation is fixed by this, not by the machine
  static constexpr uint32_t kBlock = 32;  // correspondences between two looks at the bound
  enum Row { kPx, kPy, kPz, kVx, kVy, kVz, kDx, kDy, kDz, kWeight, kStretch, kRowCount };

  Span<float> rows_[kRowCount];
  uint32_t count_ = 0;  // padded to whole blocks
};

}  // namespace sphc
