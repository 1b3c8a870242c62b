// Draws minimal samples: seeded, spread out, and the best matches first when their quality is known.
#pragma once
#include "runtime/base/arena.h"
#include "runtime/base/random.h"
#include "runtime/stages/pose/kernels.h"

namespace sphc {

class Sampler {
 public:
  static void layout(uint32_t capacity, Arena &scratch, Sampler *sampler);

  // `quality` of each of the rows (see Correspondence); `size`: points in a sample, 2 or 3.
  void start(const PoseRows &rows, Span<const float> quality, uint32_t size, uint64_t seed);
  void draw(MinimalBatch *batch);

 private:
  void sortByQuality(Span<const float> quality);
  bool isSpreadOut(const uint32_t *sample) const;

  const PoseRows *rows_ = nullptr;
  uint32_t size_ = 3, drawn_ = 0;
  bool ordered_ = false;
  float least_side2_ = 0;
  Span<uint32_t> order_;
  Random random_{0};
};

}  // namespace sphc
