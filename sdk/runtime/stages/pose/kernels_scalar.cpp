// The scalar twin: the same kernels compiled for single lanes; for tests and for machines without SIMD.
#include "runtime/base/single_lane.h"  // keep first

#include "runtime/stages/pose/equations-inl.h"
#include "runtime/stages/pose/minimal-inl.h"
#include "runtime/stages/pose/rows-inl.h"
#include "runtime/stages/pose/score-inl.h"
#include "runtime/stages/pose/upright-inl.h"

namespace sphc {

const PoseKernels &scalarPoseKernels() {
  using namespace HWY_NAMESPACE;
  static constexpr PoseKernels kernels = {
      prepare, score, residuals, planeResiduals, solveP3pBatch, solveUprightBatch, liftedEquations, planeEquations};
  return kernels;
}

}  // namespace sphc
