// The runtime's kernels with each instruction set that they were compiled for.
#pragma once
#include <hwy/highway.h>

namespace sphc::test {

// Calls check(name) once for each instruction set that this machine and the kernels have.  Where they were compiled
// for one alone (SPHC_SIMD static or scalar) there is nothing to pick, and none of libhwy to pick with.
template <typename Check>
void withEveryInstructionSet(const Check &check) {
#if HWY_TARGETS == HWY_STATIC_TARGET
  check(hwy::TargetName(HWY_STATIC_TARGET));
#else
  const auto pick = [](int64_t targets) {
    hwy::SetSupportedTargetsForTest(targets);
    hwy::GetChosenTarget().DeInit();
  };
  for (int64_t left = hwy::SupportedTargets() & HWY_TARGETS; left != 0; left &= left - 1) {
    pick(left & -left);
    check(hwy::TargetName(left & -left));
    pick(0);
  }
#endif
}

}  // namespace sphc::test
