#include "drivers/simulated/random.h"

namespace sphc::simulated {

NoiseLattice::NoiseLattice() : value() {
  for (uint32_t i = 0; i < kSide * kSide; ++i) {
    value[i] = 2 * unitFloat(hash32(static_cast<int32_t>(i % kSide), static_cast<int32_t>(i / kSide), 1)) - 1;
  }
}

const NoiseLattice kNoiseLattice;

}  // namespace sphc::simulated
