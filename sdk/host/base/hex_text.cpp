#include "host/base/hex_text.h"

#include <cstdio>

namespace sphc::host {

std::string hexText(const uint8_t *bytes, size_t count) {
  std::string text;
  char digits[3];
  for (size_t i = 0; i < count; ++i) {
    std::snprintf(digits, sizeof digits, "%02x", bytes[i]);
    text += digits;
  }
  return text;
}

}  // namespace sphc::host
