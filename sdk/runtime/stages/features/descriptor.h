// Histograms of gradients around a keypoint, as bytes (Lowe 2004, section 6; RootSIFT: Arandjelovic and Zisserman,
// "Three things everyone should know to improve object retrieval", CVPR 2012).
//
// The neighbourhood is resampled into a small patch, turned and scaled to the keypoint, so that the weights with
// which a sample enters the cells are constants.
#pragma once
#include <cstdint>

#include "runtime/base/arena.h"
#include "runtime/stages/features/kernels.h"

namespace sphc {

class Describer {
 public:
  static void layout(Arena &state, Describer *out);
  void init();

  // At (x, y) of a level of size width x height, standard deviation and direction given, in the octave's pixels.
  void describe(const FeatureKernels &kernels, const Plane &level, int32_t width, int32_t height, float x, float y,
                float sigma, float orientation, Descriptor *out) const;

 private:
  Span<PatchWindow> window_;
};

}  // namespace sphc
