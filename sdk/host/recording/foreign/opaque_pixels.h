// Colour images with a fourth channel that says nothing.
#pragma once

#include "host/recording/mcap/bytes.h"
#include "host/recording/pixels.h"

namespace sphc::recording {

// The other three, which are in the order of `recorded` (RGB8 or BGR8), as packPixels gives them in `to`.  Rows of
// `pixels` are `stride_bytes` apart.
inline void packOpaque(const uint8_t *pixels, uint32_t width, uint32_t height, uint32_t stride_bytes,
                       sphc_format recorded, sphc_format to, uint8_t *out) {
  Bytes colors;
  colors.reserve(size_t{width} * height * 3);
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width; ++x) append(colors, pixels + size_t{y} * stride_bytes + 4 * x, 3);
  packPixels({colors.data(), width, height, width * 3, recorded}, to, out);
}

}  // namespace sphc::recording
