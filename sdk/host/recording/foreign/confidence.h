// Depth that its sensor does not believe is no measurement.
#pragma once

#include <cstddef>
#include <cstdint>

#include "host/recording/mcap/bytes.h"

namespace sphc::recording {

// Both are of one size; `depth` of a lesser confidence than `least` becomes 0.
inline void dropLowConfidence(const Bytes &confidence, uint8_t least, uint16_t *depth) {
  for (size_t i = 0; i < confidence.size(); ++i)
    if (confidence[i] < least) depth[i] = 0;
}

}  // namespace sphc::recording
