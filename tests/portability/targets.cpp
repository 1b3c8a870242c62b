// The session once with each instruction set that this machine and the runtime's kernels have.
#include <hwy/highway.h>

#include <cstdio>

extern "C" {
#include "data.h"
#include "replay.h"
}

namespace {

void print(void *, const char *text) { std::puts(text); }

}  // namespace

int main() {
  int failed = 0;
  for (int64_t left = hwy::SupportedTargets() & HWY_TARGETS; left != 0; left &= left - 1) {
    hwy::SetSupportedTargetsForTest(left & -left);
    hwy::GetChosenTarget().DeInit();
    std::printf("%s\n", hwy::TargetName(left & -left));
    failed |= replay_check(data_map, static_cast<size_t>(data_map_end - data_map), data_expected, print, nullptr);
  }
  return failed;
}
