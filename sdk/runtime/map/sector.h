// Sectors: the octahedral square of directions cut into side x side equal squares.
#pragma once
#include "runtime/map/layout.h"

namespace sphc {

// Which of `side` x `side` sectors (a power of two, at most kMapMaxSectorSide) a direction lies in: row v, column
// u.
inline uint32_t sectorOf(PackedDirection packed, uint32_t side) {
  return (((packed.v - 1u) * side) >> 16) * side + (((packed.u - 1u) * side) >> 16);
}

}  // namespace sphc
