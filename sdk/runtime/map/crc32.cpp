#include "runtime/map/crc32.h"

namespace sphc {
namespace {

// Four tables, so that four bytes go in at a time ("slicing by 4", Kounavis and Berry 2005).  Eight would take 4 KB
// more of flash.
struct Tables {
  uint32_t entry[4][256];
  constexpr Tables() : entry() {
    for (uint32_t i = 0; i < 256; ++i) {
      uint32_t crc = i;
      for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) ? 0xEDB88320u : 0u);
      entry[0][i] = crc;
    }
    for (uint32_t i = 0; i < 256; ++i)
      for (int k = 1; k < 4; ++k) entry[k][i] = (entry[k - 1][i] >> 8) ^ entry[0][entry[k - 1][i] & 255];
  }
};
constexpr Tables kTables;

}  // namespace

uint32_t crc32(uint32_t crc, const void *data, size_t bytes) {
  const uint8_t *p = static_cast<const uint8_t *>(data);
  const auto &t = kTables.entry;
  crc = ~crc;
  for (; bytes >= 4; bytes -= 4, p += 4) {
    crc ^= p[0] | (uint32_t{p[1]} << 8) | (uint32_t{p[2]} << 16) | (uint32_t{p[3]} << 24);
    crc = t[3][crc & 255] ^ t[2][(crc >> 8) & 255] ^ t[1][(crc >> 16) & 255] ^ t[0][crc >> 24];
  }
  for (; bytes; --bytes) crc = (crc >> 8) ^ t[0][(crc ^ *p++) & 255];
  return ~crc;
}

}  // namespace sphc
