// libFuzzer's entry to the target named by SPHC_FUZZ_TARGET.
#include "tests/fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes) {
  sphc::fuzz::SPHC_FUZZ_TARGET(data, bytes);
  return 0;
}
