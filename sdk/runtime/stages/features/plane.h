// An image of 16-bit samples, whole or as a ring of its most recent rows.
//
// A sample is (grey - 128) * 128: the sum of two fits 16 bits, and so does the difference of any two.
#pragma once
#include <cstdint>

namespace sphc {

constexpr int32_t kGrayMiddle = 128, kSampleScale = 128;
constexpr float kSamplesPerUnit = 255.0f * kSampleScale;  // grey levels in [0, 1]

struct Plane {
  int16_t *data = nullptr;
  int32_t stride = 0;    // samples from a row to the next
  int32_t row_mask = 0;  // rows held - 1, a power of two in a ring; all ones where every row is held

  int16_t *row(int32_t y) const { return data + static_cast<int64_t>(y & row_mask) * stride; }
};

// Rows are whole vectors of every instruction set, and kernels work on whole vectors.
constexpr int32_t kRowStep = 32;
inline int32_t paddedWidth(int32_t width) { return (width + kRowStep - 1) / kRowStep * kRowStep; }

}  // namespace sphc
