// The scalar version: the same kernels compiled for single lanes; for tests and for machines without SIMD.
#include "runtime/base/single_lane.h"  // keep first

#include "runtime/stages/align/patch-inl.h"
#include "runtime/stages/align/project-inl.h"
#include "runtime/stages/align/resolve-inl.h"
#include "runtime/stages/align/sense-inl.h"

namespace sphc {

const AlignKernels &scalarAlignKernels() {
  using namespace HWY_NAMESPACE;
  static constexpr AlignKernels kernels = {patchSums,  nearestRow, senseRow,  compareRow, turnRow,
                                           projectRow, spreadRow,  decodeRow, resolveRow};
  return kernels;
}

}  // namespace sphc
