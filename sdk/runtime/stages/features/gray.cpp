#include "runtime/stages/features/gray.h"

#include "runtime/stages/features/kernels.h"

namespace sphc {
namespace {

void toGray(const uint8_t *color, bool red_first, int32_t stride, int32_t width, int32_t height, uint8_t *gray,
            int32_t gray_stride) {
  const auto gray_row = simdFeatureKernels().gray_row;
  for (int64_t y = 0; y < height; ++y) gray_row(color + y * stride, red_first, gray + y * gray_stride, width);
}

}  // namespace

void rgbToGray(const uint8_t *rgb, int32_t stride, int32_t width, int32_t height, uint8_t *gray,
               int32_t gray_stride) {
  toGray(rgb, true, stride, width, height, gray, gray_stride);
}

void bgrToGray(const uint8_t *bgr, int32_t stride, int32_t width, int32_t height, uint8_t *gray,
               int32_t gray_stride) {
  toGray(bgr, false, stride, width, height, gray, gray_stride);
}

}  // namespace sphc
