// The same kernels compiled for single lanes; for tests and for machines without SIMD.
#define HWY_COMPILE_ONLY_SCALAR
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
