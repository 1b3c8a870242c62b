#include "runtime/stages/features/gray.h"

#include <algorithm>

#include "runtime/base/assert.h"
#include "runtime/stages/features/kernels.h"

namespace sphc {
namespace {

void takeBytes(const uint8_t *row, const LumaLayout &layout, int32_t width, uint8_t *gray) {
  row += layout.first;
  for (int32_t x = 0; x < width; x += layout.group_pixels, row += layout.group_bytes)
    for (int32_t i = 0; i < layout.group_pixels; ++i) gray[x + i] = row[i];
}

void takeWords(const uint8_t *row, int32_t bits, int32_t width, uint8_t *gray) {
  for (int32_t x = 0; x < width; ++x, row += 2)
    gray[x] = static_cast<uint8_t>(std::min((row[0] | row[1] << 8) >> (bits - 8), 255));
}

void takeRow(const uint8_t *row, const LumaLayout &layout, int32_t width, uint8_t *gray) {
  switch (layout.kind) {
    case LumaLayout::kPlane:
    case LumaLayout::kBytes:
      return takeBytes(row, layout, width, gray);
    case LumaLayout::kWords:
      return takeWords(row, layout.bits, width, gray);
    case LumaLayout::kRgb:
    case LumaLayout::kBgr:
      return simdFeatureKernels().gray_row(row, layout.group_bytes, layout.kind == LumaLayout::kRgb, gray, width);
  }
}

// At the border of the image, where neighbours are missing.
uint8_t greenAtBorder(const uint8_t *gray, int32_t x, int32_t y, int32_t width, int32_t height) {
  const uint8_t *pixel = gray + int64_t{y} * width + x;
  int32_t sum = 0, count = 0;
  const auto add = [&](bool is_there, int32_t step) {
    if (is_there) sum += pixel[step], ++count;
  };
  add(x > 0, -1);
  add(x + 1 < width, 1);
  add(y > 0, -width);
  add(y + 1 < height, width);
  return static_cast<uint8_t>((sum + count / 2) / count);
}

// The pixels that are not green have only green ones beside them, so the order does not matter.
void fillWithGreens(int32_t first, int32_t width, int32_t height, uint8_t *gray) {
  for (int32_t y = 0; y < height; ++y) {
    uint8_t *row = gray + int64_t{y} * width;
    for (int32_t x = (first + y) & 1; x < width; x += 2) {
      const bool inside = x > 0 && x + 1 < width && y > 0 && y + 1 < height;
      row[x] = inside ? static_cast<uint8_t>((row[x - 1] + row[x + 1] + row[x - width] + row[x + width] + 2) >> 2)
                      : greenAtBorder(gray, x, y, width, height);
    }
  }
}

}  // namespace

GrayView grayOf(const ColorView &color, Span<uint8_t> gray) {
  const LumaLayout &layout = color.layout;
  const bool is_filtered = layout.green != LumaLayout::kNoFilter;
  if (layout.kind == LumaLayout::kPlane && !is_filtered) return color.bytes;
  const int32_t width = color.bytes.width, height = color.bytes.height;
  SPHC_ASSERT(gray.size() >= size_t(width) * size_t(height));
  for (int32_t y = 0; y < height; ++y) takeRow(color.bytes.row(y), layout, width, gray.data() + int64_t{y} * width);
  if (is_filtered) fillWithGreens(layout.green == LumaLayout::kGreenEven ? 1 : 0, width, height, gray.data());
  return {gray.data(), width, height, width};
}

}  // namespace sphc
