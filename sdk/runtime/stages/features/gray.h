// Colour rows to grey.
#pragma once
#include <cstdint>

namespace sphc {

// Interleaved 8-bit colour, `stride` bytes from a row to the next, to grey by the BT.601 weights in integers.
void rgbToGray(const uint8_t *rgb, int32_t stride, int32_t width, int32_t height, uint8_t *gray,
               int32_t gray_stride);
void bgrToGray(const uint8_t *bgr, int32_t stride, int32_t width, int32_t height, uint8_t *gray,
               int32_t gray_stride);

}  // namespace sphc
