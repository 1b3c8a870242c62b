// A float image, whole or as a ring of its most recent rows.
#pragma once
#include <cstdint>

namespace sphc {

struct Plane {
  float *data = nullptr;
  int32_t stride = 0;    // floats from a row to the next
  int32_t row_mask = 0;  // rows held - 1, a power of two in a ring; all ones where every row is held

  float *row(int32_t y) const { return data + static_cast<int64_t>(y & row_mask) * stride; }
};

// Rows start on vector boundaries.
inline int32_t paddedWidth(int32_t width) { return (width + 15) / 16 * 16; }

}  // namespace sphc
