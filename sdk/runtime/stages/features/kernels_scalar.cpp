// The scalar version: the same kernels compiled for single lanes; for tests and for machines without SIMD.
#include "runtime/base/single_lane.h"  // keep first

#include "runtime/stages/features/blur-inl.h"
#include "runtime/stages/features/descriptor-inl.h"
#include "runtime/stages/features/extrema-inl.h"
#include "runtime/stages/features/gray-inl.h"
#include "runtime/stages/features/orientation-inl.h"

namespace sphc {

const FeatureKernels &scalarFeatureKernels() {
  using namespace HWY_NAMESPACE;
  static constexpr FeatureKernels kernels = {
      scaleRow, doubleRow, halveRow, blurRows, findExtrema, orientationHistogram, describePatch, grayRow};
  return kernels;
}

}  // namespace sphc
