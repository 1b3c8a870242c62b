// A query descriptor and the map point it resembles most.
#pragma once
#include <cstdint>

namespace sphc {

struct Match {
  uint32_t query;        // index of the keypoint
  uint32_t point_index;  // of the map point
  uint32_t distance2;    // squared L2 distance of the byte descriptors
  uint32_t second2;      // of the runner-up
};

}  // namespace sphc
