// CRC-32 of IEEE 802.3 (as zlib's and Python's crc32).
#pragma once
#include <cstddef>
#include <cstdint>

namespace sphc {

// Continues `crc` (0 to begin) over more bytes.
uint32_t crc32(uint32_t crc, const void *data, size_t bytes);

}  // namespace sphc
