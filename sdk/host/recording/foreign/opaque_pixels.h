// Colour images with a fourth channel that says nothing.
#pragma once

#include "host/recording/mcap/bytes.h"

namespace sphc::recording {

// The other three, rows without padding.
inline Bytes opaquePixels(const uint8_t *pixels, uint32_t width, uint32_t height, uint32_t stride_bytes) {
  Bytes colors;
  colors.reserve(size_t{width} * height * 3);
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width; ++x) append(colors, pixels + size_t{y} * stride_bytes + 4 * x, 3);
  return colors;
}

}  // namespace sphc::recording
