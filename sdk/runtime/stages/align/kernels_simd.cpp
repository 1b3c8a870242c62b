// The kernels in the best instruction set of this machine: Highway compiles them once for each and picks at run
// time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "runtime/stages/align/kernels_simd.cpp"
#include <hwy/foreach_target.h>  // keep before highway.h
#include <hwy/highway.h>

#include "runtime/stages/align/patch-inl.h"
#include "runtime/stages/align/project-inl.h"
#include "runtime/stages/align/resolve-inl.h"
#include "runtime/stages/align/sense-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sphc {
namespace HWY_NAMESPACE {

const AlignKernels *alignKernels() {
  static constexpr AlignKernels kernels = {patchSums,  nearestRow, senseRow,  compareRow, turnRow,
                                           projectRow, spreadRow,  decodeRow, resolveRow};
  return &kernels;
}

}  // namespace HWY_NAMESPACE
}  // namespace sphc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sphc {

HWY_EXPORT(alignKernels);
const AlignKernels &simdAlignKernels() { return *HWY_DYNAMIC_DISPATCH(alignKernels)(); }

}  // namespace sphc
#endif
