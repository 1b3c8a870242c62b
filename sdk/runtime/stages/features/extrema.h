// Extrema of the difference of Gaussians in space and scale, refined (Lowe 2004, sections 3.1, 4 and 4.1).
#pragma once
#include <cstdint>

#include "runtime/base/arena.h"
#include "runtime/stages/features/candidates.h"
#include "runtime/stages/features/config.h"
#include "runtime/stages/features/sweep.h"

namespace sphc {

// Value and derivatives of the difference of Gaussians at a sample, by central differences, in samples.
struct Derivatives {
  float value;
  float dx, dy, ds;
  float dxx, dyy, dss, dxy, dxs, dys;
};

class ExtremaFinder {
 public:
  static void layout(const FeatureConfig &config, Arena &scratch, ExtremaFinder *out);

  // After step y of the sweep: finds the extrema of the row that the sweep has made complete, if it is of its
  // piece.
  void step(const FeatureKernels &kernels, const Sweep &sweep, int32_t y, CandidateList *found);

 private:
  void examine(const Sweep &sweep, int32_t x, int32_t y, int32_t level, CandidateList *found) const;

  void accept(const Sweep &sweep, const Derivatives &derivatives, const float offset[3], int32_t x, int32_t y,
              int32_t level, CandidateList *found) const;

  float threshold_ = 0, edge_limit_ = 0;  // threshold in samples
  int16_t early_threshold_ = 0;
  Span<uint16_t> columns_;
};

}  // namespace sphc
