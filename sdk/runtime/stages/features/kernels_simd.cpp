// The kernels in the best instruction set of this machine: Highway compiles them once for each and picks at run
// time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "runtime/stages/features/kernels_simd.cpp"
#include <hwy/foreach_target.h>  // keep before highway.h
#include <hwy/highway.h>

#include "runtime/stages/features/blur-inl.h"
#include "runtime/stages/features/descriptor-inl.h"
#include "runtime/stages/features/extrema-inl.h"
#include "runtime/stages/features/gray-inl.h"
#include "runtime/stages/features/orientation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sphc {
namespace HWY_NAMESPACE {

const FeatureKernels *featureKernels() {
  static constexpr FeatureKernels kernels = {
      scaleRow, doubleRow, halveRow, blurRows, findExtrema, orientationHistogram, describePatch, grayRow};
  return &kernels;
}

}  // namespace HWY_NAMESPACE
}  // namespace sphc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sphc {

HWY_EXPORT(featureKernels);
const FeatureKernels &simdFeatureKernels() { return *HWY_DYNAMIC_DISPATCH(featureKernels)(); }

}  // namespace sphc
#endif
