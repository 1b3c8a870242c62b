// The channels of a pixel: from colour to grey, and red in the place of blue.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

namespace sphc::host {

// 32768 times the grey of a colour, by the weights with which OpenCV and libpng read a colour PNG.
constexpr uint32_t weightedGray(uint32_t red, uint32_t green, uint32_t blue) {
  return 9797 * red + 19234 * green + 3737 * blue;
}

// As OpenCV reads a colour PNG to grey, so that a recording gives the same through each of its layouts.
constexpr uint8_t grayOf(uint32_t red, uint32_t green, uint32_t blue) {
  return static_cast<uint8_t>(weightedGray(red, green, blue) >> 15);
}

// Of so many pixels with three or four channels.
inline void swapRedAndBlue(uint8_t *pixels, size_t count, size_t channels) {
  for (uint8_t *pixel = pixels; pixel != pixels + channels * count; pixel += channels)
    std::swap(pixel[0], pixel[2]);
}

}  // namespace sphc::host
