// Images turned over.
#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

namespace sphc::host {

// Left becomes right.  `width` in pixels of `values` numbers each.
template <typename T>
void mirror(uint32_t width, uint32_t height, uint32_t values, std::vector<T> *pixels) {
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width / 2; ++x) {
      T *row = pixels->data() + size_t{y} * width * values;
      std::swap_ranges(row + x * values, row + (x + 1) * values, row + (width - 1 - x) * values);
    }
}

template <typename T>
void turnUpsideDown(uint32_t width, uint32_t height, uint32_t values, std::vector<T> *pixels) {
  const size_t row = size_t{width} * values;
  for (uint32_t y = 0; y < height / 2; ++y)
    std::swap_ranges(pixels->begin() + static_cast<std::ptrdiff_t>(y * row),
                     pixels->begin() + static_cast<std::ptrdiff_t>((y + 1) * row),
                     pixels->begin() + static_cast<std::ptrdiff_t>((height - 1 - y) * row));
}

}  // namespace sphc::host
