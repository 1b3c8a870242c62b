// RVL, the lossless depth codec of Wilson ("Fast Lossless Depth Image Compression", ISS 2017), in the bytes that
// ROS knows as "compressedDepth rvl".
#pragma once

#include "bytes.h"

namespace sphc::recording {

// Room that always suffices.
constexpr size_t rvlMostBytes(size_t pixels) { return 3 * pixels + 16; }

// Gives the bytes written to `out`, which has rvlMostBytes(count) of room.
size_t encodeRvl(const uint16_t *depth, size_t count, uint8_t *out);

// Fills exactly `count` pixels; false when the bytes are too few or say something else.
bool decodeRvl(ByteView encoded, uint16_t *depth, size_t count);

}  // namespace sphc::recording
