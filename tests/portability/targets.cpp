// The session once with each instruction set that this machine and the runtime's kernels have.
#include <cstdio>

#include "tests/support/every_instruction_set.h"

extern "C" {
#include "data.h"
#include "replay.h"
}

namespace {

void print(void *, const char *text) { std::puts(text); }

}  // namespace

int main() {
  int failed = 0;
  sphc::test::withEveryInstructionSet([&](const char *name) {
    std::puts(name);
    failed |= replay_check(data_map, static_cast<size_t>(data_map_end - data_map), data_expected, print, nullptr);
  });
  return failed;
}
