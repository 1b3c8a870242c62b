// The kernels in the best instruction set of this machine: Highway compiles them once for each and picks at run
// time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "runtime/stages/pose/kernels_simd.cpp"
#include <hwy/foreach_target.h>  // keep before highway.h
#include <hwy/highway.h>

#include "runtime/stages/pose/equations-inl.h"
#include "runtime/stages/pose/minimal-inl.h"
#include "runtime/stages/pose/rows-inl.h"
#include "runtime/stages/pose/score-inl.h"
#include "runtime/stages/pose/upright-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sphc {
namespace HWY_NAMESPACE {

const PoseKernels *kernels() {
  static constexpr PoseKernels kernels = {
      prepare, score, residuals, planeResiduals, solveP3pBatch, solveUprightBatch, liftedEquations, planeEquations};
  return &kernels;
}

}  // namespace HWY_NAMESPACE
}  // namespace sphc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sphc {

HWY_EXPORT(kernels);
const PoseKernels &simdPoseKernels() { return *HWY_DYNAMIC_DISPATCH(kernels)(); }

}  // namespace sphc
#endif
